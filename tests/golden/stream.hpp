/// The golden streams: recorded inputs of sensors and users.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/chip/messages.hpp"
#include "host/run/planners.hpp"

namespace whisker::golden {

/// A part of the recording.
struct Stream {
  std::string name;
  chip::Bytes messages;
};

/// Inputs of the response table: every node of the look-up, a point inside every cell, the ends of the range.
Stream table_sweep();

/// Drives in simulated worlds, with every planner for chips.
std::vector<Stream> drives();
/// Faulty boards, random users, and robots with any accepted parameters.
std::vector<Stream> storms();
/// One of them. fury: see StormBoard. Seed 1 has the default robot, others a random one.
Stream storm(PlannerKind kind, std::uint64_t seed, int fury, int ticks);
/// The first ticks of some of them, for targets with a slow emulator.
std::vector<Stream> excerpts();
/// For the small core, which has no boundary planner and no map: drives with the thesis planner. Even ticks
/// and sound wheels, which the small core assumes.
std::vector<Stream> thesis_only();

/// The streams one after the other, between a hello and an end; `index` gets a line for each: the offset of
/// its first byte, and its name.
chip::Bytes recording(const std::vector<Stream>& streams, std::string& index);

}  // namespace whisker::golden
