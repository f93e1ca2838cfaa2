#pragma once

#include <string>

namespace whisker::hil {

/// Gives this thread real-time priority, which a tick in every period needs. Threads and processes that it
/// starts later have normal priority. Returns the error if it is not permitted; empty: no error.
std::string take_precedence();

}  // namespace whisker::hil
