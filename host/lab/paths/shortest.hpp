/// The shortest path of a round body among discs and segments, exact except for rounding.
///
/// The centre of a body of radius r must keep the distance r from every obstacle. A shortest path therefore
/// consists of straight lines and of arcs around discs and around ends of segments, each tangent to the next.
/// The search runs on the graph of all such lines (Liu and Arimoto, Path planning using a tangent graph for
/// mobile robots among polygonal and curved obstacles, Int. J. Robotics Research 11, 1992).
///
/// Movers are ignored. Solids count by their outlines, so both points must lie outside polygons. A gap that
/// is too narrow by less than 2e-9 m counts as passable.
#pragma once

#include <optional>
#include <vector>

#include "host/harness/scenario/world.hpp"

namespace whisker::paths {

/// A straight line, or an arc around a centre.
struct Leg {
  sim::Vec2 from, to;
  sim::Disc around;     ///< of an arc: its centre and radius
  double turn_rad = 0;  ///< counter-clockwise; 0: a straight line
};

double length_m(const Leg& leg);

struct Way {
  double length_m = 0;
  std::vector<Leg> legs;  ///< each begins where the last one ends; empty if the two points coincide
};

/// None if the body cannot get from one point to the other, or is too near to an obstacle at one of them.
/// radius_m > 0. Lengths are accurate to 1e-6 m in worlds of up to 1000 m.
std::optional<Way> shortest_way(const World& world, sim::Vec2 from, sim::Vec2 to, double radius_m);

/// The length of shortest_way, m.
std::optional<double> shortest_path(const World& world, sim::Vec2 from, sim::Vec2 to, double radius_m);

}  // namespace whisker::paths
