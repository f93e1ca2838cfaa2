#pragma once

#include <string>

namespace whisker::protocol {

/// Frames of robot 1 as the codec writes them: a section of docs/protocol.md.
std::string examples();

}  // namespace whisker::protocol
