#pragma once

#include <stdexcept>
#include <string>

#include "host/run/pilot.hpp"

namespace whisker::chip {

/// The chip cannot hold the planner's map.
class NoRoom : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The core at the other end of a command's standard input and output, for example an image in an emulator:
/// the simulator waits for it at every tick. The command must speak firmware/apps/pil_link/message.hpp.
/// Throws ChipError, NoRoom and NoSuchPlanner.
MakePilot chip_pilot(const std::string& command);

}  // namespace whisker::chip
