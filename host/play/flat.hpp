/// A scenario as a list of numbers: how the playground's page hands it over.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/scenario/scenario.hpp"

namespace whisker::play {

/// In this order, SI units; a list of points is its length and their coordinates, a list of things its length
/// and those:
///   seed, time limit; start x, y; goal x, y, tolerance;
///   1 and min x, min y, max x, max y of the bounds, or 0;
///   discs: x, y, radius; polygons: points; walls: points; movers: centre x, y, radius, speed, points;
///   the five of Noise, in its order.
/// The robot is the reference robot; it starts towards the goal. The seed is below 2^53.
std::vector<double> flat(const Scenario& scenario);

/// So much the page takes, of obstacles of all kinds together and of points of polygons, walls and paths: one
/// more would be too slow to draw and to drive. A file may have more.
constexpr std::size_t kMostThings = 1000;
constexpr std::size_t kMostPointsOfAll = 4096;

/// Nothing if the list ends too early or too late, has more than that, or says what a scenario file may not
/// say.
std::optional<Scenario> scenario_of(const std::vector<double>& list);

}  // namespace whisker::play
