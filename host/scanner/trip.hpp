/// A yardstick for planners: what a robot would drive that sees all round and forgets nothing.
///
/// A disc-shaped body with a scanner at its centre takes the shortest way to the goal through what it has
/// seen free or has not seen yet, looks all round every 50 mm, and takes another way as soon as something new
/// is in this one. It has neither dynamics nor margins.
#pragma once

#include <optional>

#include "host/scenario/world.hpp"

namespace whisker::scanner {

struct Trip {
  bool reached = false;  ///< false: what it saw leaves no way to the goal
  double driven_m = 0;
  /// The shortest way through all of the same outlines, none without one. No trip that reaches the goal is
  /// shorter but for 1 part in 1000: the body is held against the world every 10 mm.
  std::optional<double> shortest_m;
};

/// Movers are ignored. Both points must lie outside solids. radius_m and range_m > 0.
/// Throws std::runtime_error after 100,000 ways without an end.
Trip drive(const World& world, sim::Vec2 from, sim::Vec2 to, double radius_m, double range_m);

}  // namespace whisker::scanner
