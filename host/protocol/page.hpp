#pragma once

#include <string>

namespace whisker::protocol {

/// docs/protocol.md: every message with its signals, times, errors and parameters, for a reader.
std::string page();
/// The companion's protocol on a byte stream for a reader: docs/link.md.
std::string link_page();

}  // namespace whisker::protocol
