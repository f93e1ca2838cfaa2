#pragma once

#include <string>

namespace whisker::hil {

/// Lets this process run before all ordinary ones, as a tick each period needs. Returns what forbids it;
/// empty: nothing did.
std::string take_precedence();

}  // namespace whisker::hil
