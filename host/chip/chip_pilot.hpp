#pragma once

#include <stdexcept>
#include <string>

#include "host/run/pilot.hpp"

namespace whisker::chip {

/// The planner's map does not fit into the chip.
class NoRoom : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The core behind the standard input and output of a command, for example an image in an emulator; the
/// simulator waits for it at every tick. The command must implement firmware/apps/pil_link/message.hpp.
/// Throws ChipError, NoRoom and NoSuchPlanner.
MakePilot chip_pilot(const std::string& command);

}  // namespace whisker::chip
