/// One mission of a campaign: its definition and its result.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/harness/run/record.hpp"

namespace whisker::campaign {

/// Fractions are multiples of 1e-6, so that a row in a file equals the row in memory.
struct Row {
  std::uint64_t seed = 0;
  Verdict verdict = Verdict::gave_up;
  double time_s = 0;
  double path_m = 0;  ///< driven
  double turned_rad = 0;
  std::uint64_t stops = 0, flips = 0, looks = 0;  ///< as MotionCount defines them
  double min_clearance_m = 0;
  double final_distance_m = 0;                ///< true
  std::optional<double> believed_distance_m;  ///< by the robot's estimate; none: the row has no value
  double estimate_error_m = 0;                ///< at the end, between the true and the estimated position
  bool at_goal = false;                       ///< final_distance_m is within the goal tolerance
  std::optional<double> shortest_m;  ///< shortest path for a disc of kWayRadius; none: no path exists
  std::uint64_t ticks = 0;
  std::uint64_t hash = 0;
  std::string detail;
  std::string planner;
  std::string robot;  ///< robot file; empty: the scenario's robot
  /// Arguments of `whisker world` without the seed, then kRandomRobots for such robots; or a scenario file
  /// (*.toml).
  std::string world;
  /// The number of this mission in its whole campaign, from 1, of so many; 0: unknown.
  std::uint64_t mission = 0, missions = 0;
};

/// x rounded to the nearest multiple of 1e-6.
double rounded(double x);

std::optional<double> ratio(const Row& row);    ///< path driven to shortest path
std::optional<double> s_per_m(const Row& row);  ///< of the shortest path; none without one

/// The world is known to have no path to its goal: the correct verdict is "unreachable".
bool has_no_way(const Row& row);
/// The verdict is correct as far as the robot can know: off the goal without knowing it is a success.
bool succeeded(const Row& row);
/// The robot reports that it has reached its goal, and it has.
bool truly_there(const Row& row);

}  // namespace whisker::campaign
