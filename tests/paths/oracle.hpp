/// An independent path search: on a grid, then shortened. It shares no code with host/lab/paths.
#pragma once

#include <optional>

#include "host/harness/scenario/world.hpp"

namespace whisker::paths {

/// The length of a feasible path of a body with this radius, m: not shorter than the shortest. None if the
/// grid of 3 cm contains none.
std::optional<double> some_way(const World& world, sim::Vec2 from, sim::Vec2 to, double radius_m);

/// Distance from the point to the nearest obstacle, m: infinite in an empty world.
double gap(const World& world, sim::Vec2 p);

}  // namespace whisker::paths
