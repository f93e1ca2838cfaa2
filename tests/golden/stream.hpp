/// The golden streams: recorded inputs of sensors and users.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/harness/run/planners.hpp"
#include "tests/golden/messages.hpp"

namespace whisker::golden {

/// A part of the recording.
struct Stream {
  std::string name;
  Bytes messages;
  std::uint64_t hash = 0;  ///< of the commands of the drive that it records; 0: it is no drive
};

/// Inputs of the response table: every node of the look-up, a point inside every cell, the ends of the range.
Stream table_sweep();

/// Drives in simulated worlds, with every planner for chips.
std::vector<Stream> drives();
/// Faulty boards, random users, and robots with any accepted parameters.
std::vector<Stream> storms();

/// The streams one after the other, and an end; `index` gets a line for each: the offset of
/// its first byte, and its name.
Bytes recording(const std::vector<Stream>& streams, std::string& index);

}  // namespace whisker::golden
