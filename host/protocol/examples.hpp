#pragma once

#include <string>

namespace whisker::protocol {

/// Frames of robot 1 encoded by the codec: a section of docs/protocol.md.
std::string examples();

}  // namespace whisker::protocol
