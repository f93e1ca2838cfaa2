/// Follows a path in closed loop.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/guard/operator.hpp"
#include "host/scenario/scenario.hpp"

namespace whisker::guard {

/// The shortest path from start to goal that keeps this distance from all obstacles, as points 1 cm apart.
/// None if there is no such path.
std::optional<std::vector<sim::Vec2>> path_with_margin(const Scenario& scenario, double margin_m);

struct Limits {
  double speed_mps;
  double turn_radps;
};
Limits limits_of(const Scenario& scenario);

/// Drives towards the point one body radius ahead on the path, and stops at its end.
class PathFollower : public Operator {
 public:
  PathFollower(std::vector<sim::Vec2> path, double radius_m, Limits limits);
  Twist ask(const Sight& sight) override;

 protected:
  /// Moves the point that it drives to.
  virtual sim::Vec2 off(sim::Vec2 target, const Sight&) { return target; }

 private:
  std::vector<sim::Vec2> path_;
  double ahead_m_;
  Limits limits_;
  std::size_t at_ = 0;  // nearest point so far
};

}  // namespace whisker::guard
