/// How a run ended, and the simulator's check of the robot's report.
#pragma once

#include <cstdint>

#include "host/harness/sim/elementary.hpp"

namespace whisker {

enum class Verdict {
  reached,   ///< the robot reports it, and it is true
  off_goal,  ///< the robot reports reached, but its true position is outside the goal tolerance
  unreachable,
  gave_up,
  contact,
  fault
};

/// The robot believes that it has reached its goal.
constexpr bool says_reached(Verdict verdict) {
  return verdict == Verdict::reached || verdict == Verdict::off_goal;
}

/// Whole micrometres, the unit of positions in the core and the last digit of every file.
inline std::int64_t micrometres(double metres) { return sim::whole_below(metres * 1e6 + 0.5); }

/// The true distance is at most the tolerance, both in whole micrometres. So the printed figures always give
/// the same verdict.
inline bool at_goal(double distance_m, double tolerance_m) {
  return distance_m <= tolerance_m || micrometres(distance_m) <= micrometres(tolerance_m);
}

/// The verdict on a robot that reports `said` at this true distance from the centre of its goal.
inline Verdict judged(Verdict said, double distance_m, double tolerance_m) {
  const bool wrong = said == Verdict::reached && !at_goal(distance_m, tolerance_m);
  return wrong ? Verdict::off_goal : said;
}

}  // namespace whisker
