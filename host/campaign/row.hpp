/// One mission of a campaign: what it was and what came of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/run/record.hpp"

namespace whisker::campaign {

/// Numbers with a fraction are multiples of 1e-6, so that a row in a file equals the row in memory.
struct Row {
  std::uint64_t seed = 0;
  Verdict verdict = Verdict::gave_up;
  double time_s = 0;
  double path_m = 0;  ///< driven
  double turned_rad = 0;
  std::uint64_t stops = 0, flips = 0, looks = 0;  ///< as MotionCount defines them
  double min_clearance_m = 0;
  double final_distance_m = 0;                ///< true
  std::optional<double> believed_distance_m;  ///< by the robot's estimate; none: the row does not tell
  double estimate_error_m = 0;       ///< at the end, between the true place and the robot's estimate of it
  bool at_goal = false;              ///< final_distance_m is within the goal's tolerance
  std::optional<double> shortest_m;  ///< shortest way for a disc of kWayRadius; none: there is no way
  std::uint64_t ticks = 0;
  std::uint64_t hash = 0;
  std::string detail;
  std::string planner;
  std::string robot;  ///< file of the robot's parameters; empty: the scenario's
  std::string world;  ///< arguments of `whisker world` without the seed, or a scenario file (*.toml)
};

/// The multiple of 1e-6 nearest to x.
double rounded(double x);

std::optional<double> ratio(const Row& row);    ///< driven path to shortest way
std::optional<double> s_per_m(const Row& row);  ///< of the shortest way; none without one

/// The world is known to have no way to its goal: the right verdict is "unreachable".
bool has_no_way(const Row& row);
/// The verdict is the right one by what the robot can know: to be off the goal and not to know it succeeds.
bool succeeded(const Row& row);
/// The robot says that it has reached its goal, and it has.
bool truly_there(const Row& row);

}  // namespace whisker::campaign
