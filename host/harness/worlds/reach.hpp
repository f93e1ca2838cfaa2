/// Whether a round body can get from one point to another, by a flood fill of a grid of 2 cm.
///
/// Between the two functions lies a band of radii for which both return false: a path for radius r +
/// kPathBand makes path_proven(r) true; if there is no path for r - kPathBand, even to within tolerance +
/// 0.015 m, path_ruled_out(r) is true. Movers are ignored. Solids count by their outlines, so both points
/// must lie outside polygons. For bodies of 0.05 m and more; throws std::length_error for a world of more
/// than 4 million cells (40 m x 40 m).
#pragma once

#include "host/harness/scenario/world.hpp"

namespace whisker::worlds {

constexpr double kPathBand = 0.029;  ///< m

/// True: a path for a body of this radius exists from `from` to `to`.
bool path_proven(const World& world, sim::Vec2 from, sim::Vec2 to, double radius_m);

/// True: no body of this radius gets from `from` to any point within `tolerance_m` of `to`.
bool path_ruled_out(const World& world, sim::Vec2 from, sim::Vec2 to, double tolerance_m, double radius_m);

}  // namespace whisker::worlds
