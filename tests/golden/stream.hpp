/// The golden streams: everything that a robot's sensors and its user can say, recorded.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/chip/messages.hpp"
#include "host/run/planners.hpp"

namespace whisker::golden {

/// A part of the recording, by what it shows.
struct Stream {
  std::string name;
  chip::Bytes messages;
};

/// Inputs of the response table: every node of the look-up, a point inside every cell, the ends of the range.
Stream table_sweep();

/// Drives in simulated worlds, with every planner that chips have.
std::vector<Stream> drives();
/// Boards that lie, refuse and jump, users who interfere, and robots of any accepted parameters.
std::vector<Stream> storms();
/// One of them. fury: see StormBoard. Seed 1 has the default robot, others any.
Stream storm(PlannerKind kind, std::uint64_t seed, int fury, int ticks);
/// The beginnings of some of them, for targets whose emulator is slow.
std::vector<Stream> excerpts();
/// For the small core, which has no boundary planner and no map: drives with the thesis planner.
/// Even ticks and sound wheels, which the small core takes for granted.
std::vector<Stream> thesis_only();

/// The streams one after the other, begun with a hello and ended; `index` gets a line for each: where its
/// first byte lies, and its name.
chip::Bytes recording(const std::vector<Stream>& streams, std::string& index);

}  // namespace whisker::golden
