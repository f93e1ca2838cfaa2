/// Two ways to drive, in the same worlds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/lab/campaign/bounds.hpp"
#include "host/lab/campaign/row.hpp"

namespace whisker::campaign {

/// One mission driven both ways.
struct Pair {
  Row a, b;
  double jerk_a = 0, jerk_b = 0;  ///< root mean square, m/s^3
};

struct Comparison {
  std::uint64_t worlds = 0;                      ///< at least 1
  Estimate there_a, there_b;                     ///< truly at the goal
  Estimate success_a, success_b;                 ///< right by the robot's own estimate
  std::uint64_t only_a = 0, only_b = 0;          ///< worlds in which one alone succeeds
  std::uint64_t contacts_a = 0, contacts_b = 0;  ///< missions that end in one
  std::uint64_t both = 0;                        ///< both report "reached"; the rest counts these worlds only

  /// Geometric means of b / a; none without such a world.
  std::optional<Estimate> time, path, jerk;
  /// Means of b - a; per metre of the shortest path, or metres of the smallest clearance.
  std::optional<Estimate> stops, flips, clearance;
};

/// At least one pair; the rows of each have the same world.
Comparison compare(const std::vector<Pair>& pairs);

/// Root mean square of the jerk of the body's forward motion, from its true speed at each tick.
class JerkMeter {
 public:
  void add(double t_s, double speed_mps);
  double rms() const;

 private:
  double t_s_ = 0, speed_ = 0, acceleration_ = 0, squares_ = 0, seconds_ = 0;
  int seen_ = 0;
};

}  // namespace whisker::campaign
