/// Another way to find ways: over a grid, then pulled tight. It shares no code with host/paths.
#pragma once

#include <optional>

#include "host/scenario/world.hpp"

namespace whisker::paths {

/// The length of some way that the body of this radius can go, m: no shorter than the shortest. None if the
/// grid of 3 cm shows none.
std::optional<double> some_way(const World& world, sim::Vec2 from, sim::Vec2 to, double radius_m);

/// From the point to the nearest obstacle, m: infinite in an empty world.
double gap(const World& world, sim::Vec2 p);

}  // namespace whisker::paths
