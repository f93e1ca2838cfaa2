#pragma once

#include "host/harness/scenario/scenario.hpp"

namespace whisker::worlds {

/// Multiplies every length of the world by `factor`: start, goal and its tolerance, bounds, discs, polygons,
/// walls, and the movers with their paths. A start heading towards the goal remains so. The robot, its sensor
/// and noise, the speeds and the time limit remain. 0 < factor <= 1000 / the largest coordinate; 1 changes
/// nothing.
void scale_lengths(Scenario& scenario, double factor);

}  // namespace whisker::worlds
