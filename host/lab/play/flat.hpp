/// A scenario as a list of numbers, the form in which the page of the playground passes it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/harness/scenario/scenario.hpp"

namespace whisker::play {

/// In this order, SI units; a list of points is its length and their coordinates, a list of objects its
/// length and the objects:
///   seed, time limit; start x, y; goal x, y, tolerance;
///   1 and min x, min y, max x, max y of the bounds, or 0;
///   discs: x, y, radius; polygons: points; walls: points; movers: centre x, y, radius, speed, points;
///   the five of Noise, in its order.
/// The robot is the reference robot; it starts towards the goal. The seed is below 2^53.
std::vector<double> flat(const Scenario& scenario);

/// Limits of the page, for obstacles of all kinds together and for points of polygons, walls and paths:
/// larger worlds would be too slow to draw and to run. A file may have more.
constexpr std::size_t kMostThings = 1000;
constexpr std::size_t kMostPointsOfAll = 4096;

/// None if the list is too short or too long, exceeds these limits, or violates the rules of a scenario file.
std::optional<Scenario> scenario_of(const std::vector<double>& list);

}  // namespace whisker::play
