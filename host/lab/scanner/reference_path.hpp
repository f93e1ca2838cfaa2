/// The omniscient reference for planners: the path of a robot with all-round view and perfect memory.
///
/// A disc-shaped body with a sensor at its centre follows the shortest path to the goal through ground that
/// it has seen free or has not seen yet. It scans all round every 50 mm, and changes its path as soon as
/// something new blocks it. It has neither dynamics nor margins.
#pragma once

#include <optional>

#include "host/harness/scenario/world.hpp"

namespace whisker::scanner {

struct ReferencePath {
  bool reached = false;  ///< false: the seen outlines leave no path to the goal
  double driven_m = 0;
  /// The shortest path through all of the same outlines, none if it does not exist. A reference that reaches
  /// the goal is at most 1 part in 1000 shorter, because the body is checked against the world every 10 mm.
  std::optional<double> shortest_m;
};

/// Movers are ignored. Both points must lie outside solids. radius_m and range_m > 0. Throws
/// std::runtime_error after 100,000 paths without an end.
ReferencePath drive(const World& world, sim::Vec2 from, sim::Vec2 to, double radius_m, double range_m);

}  // namespace whisker::scanner
