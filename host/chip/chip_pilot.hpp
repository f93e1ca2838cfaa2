#pragma once

#include <string>

#include "host/run/pilot.hpp"

namespace whisker::chip {

/// The core at the other end of a command's standard input and output, for example an image in an emulator:
/// the simulator waits for it at every tick. The command must speak hal/link/message.hpp. Throws ChipError.
/// The planner must be one that chips have, see is_baseline().
MakePilot chip_pilot(const std::string& command);

}  // namespace whisker::chip
