/// The golden streams: everything that a robot's sensors and its user can say, recorded.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/chip/words.hpp"

namespace whisker::golden {

/// A part of the recording, by what it shows.
struct Stream {
  std::string name;
  chip::Bytes messages;
};

/// Inputs of the response table: every node of the look-up, the middle of every cell, the ends of the range.
Stream table_sweep();

/// Drives in simulated worlds, with either planner.
std::vector<Stream> drives();

/// Boards that lie, refuse and jump, users who interfere, and robots of any accepted parameters.
std::vector<Stream> storms();

/// All of them, begun with a hello and ended; `index` gets a line for each: where its first byte lies, and its name.
chip::Bytes recording(std::string& index);

}  // namespace whisker::golden
