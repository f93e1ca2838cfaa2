/// A rule base as a picture: the memberships of every variable and each output over the free inputs.
#pragma once

#include <string>
#include <vector>

#include "host/rules/surface.hpp"

namespace whisker::rules {

/// SVG. The surface must be of this rule base.
std::string picture(const RuleBase& base, const Surface& surface);

}  // namespace whisker::rules
