#pragma once

#include <string>

namespace whisker::hil {

/// Lets this thread run before all ordinary ones, as a tick each period needs. Threads and processes that it
/// starts later are ordinary. Returns what forbids it; empty: nothing did.
std::string take_precedence();

}  // namespace whisker::hil
