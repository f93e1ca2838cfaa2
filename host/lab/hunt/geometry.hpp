/// Distances of the judge, computed apart from host/harness/sim.
#pragma once

#include <cstddef>

#include "host/harness/scenario/scenario.hpp"

namespace whisker::hunt {

double length(sim::Vec2 v);

struct Near {
  double distance_m;  ///< negative inside a solid or beyond the bounds; infinite in an empty world
  sim::Vec2 at;       ///< the nearest point of an obstacle
};

/// The nearest obstacle that stands still.
Near nearest(const Scenario& scenario, sim::Vec2 from);
/// Discs, walls, polygons and the bounds.
std::size_t count_shapes(const Scenario& scenario);

/// A disc of this radius has a way from the start to the goal, found on a grid that is finer than the disc.
/// False also if only a narrow way exists, or the world is too large to say.
bool has_way(const Scenario& scenario, double radius_m);

}  // namespace whisker::hunt
