#pragma once

#include <string>

namespace whisker::protocol {

/// docs/protocol.md: every message with its signals, times, errors and parameters.
std::string page();
/// docs/link.md: the companion's protocol on a byte stream.
std::string link_page();

}  // namespace whisker::protocol
