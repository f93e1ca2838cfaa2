#pragma once

#include <string>

namespace whisker::protocol {

/// docs/protocol.md: every message with its signals, times, errors and parameters.
std::string page();

}  // namespace whisker::protocol
