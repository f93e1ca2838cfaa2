/// Distances and tests on points, segments and polygons, in metres.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "host/harness/sim/geometry.hpp"

namespace whisker {

double distance(sim::Vec2 a, sim::Vec2 b);
/// From the point to the nearest point of the segment, which may have length 0.
double distance(sim::Vec2 p, const sim::Segment& s);
/// From the point to the nearest point of the polyline; two points or more.
double distance(sim::Vec2 p, const std::vector<sim::Vec2>& polyline);

bool intersect(const sim::Segment& a, const sim::Segment& b);

/// Edge i of the closed polygon: from point i to the next one.
sim::Segment edge(const std::vector<sim::Vec2>& polygon, std::size_t i);
/// Positive for counter-clockwise order, m^2.
double signed_area(const std::vector<sim::Vec2>& polygon);
/// Even-odd rule; the result for a point of the outline is undefined.
bool inside(sim::Vec2 p, const std::vector<sim::Vec2>& polygon);
/// Two edges that pass through each other, each with an end on either side; the lower index first.
std::optional<std::pair<std::size_t, std::size_t>> passing_edges(const std::vector<sim::Vec2>& polygon);
/// Two edges that cross, touch or fold back on each other; the lower index first.
std::optional<std::pair<std::size_t, std::size_t>> crossing_edges(const std::vector<sim::Vec2>& polygon);

}  // namespace whisker
