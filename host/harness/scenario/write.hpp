#pragma once

#include <string>

#include "host/harness/scenario/scenario.hpp"

namespace whisker {

/// The scenario as a file that loads back equal, bit for bit. A heading that is neither towards the
/// goal nor a whole double of degrees loads back within one unit in the last place.
/// Precondition: seed < 2^63 (TOML integers are signed).
std::string to_toml(const Scenario& scenario);

}  // namespace whisker
