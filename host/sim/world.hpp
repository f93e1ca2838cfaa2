/// What surrounds the robot: a view of arrays that somebody else owns.
#pragma once

#include <stddef.h>

#include "host/sim/geometry.hpp"

namespace whisker::sim {

/// A disc whose centre runs along a polyline at constant speed, there and back for ever.
struct MovingDisc {
  const Vec2* points = nullptr;
  size_t count = 0;   ///< at least 1
  double radius = 0;  ///< m
  double speed = 0;   ///< m/s, not negative
  double start_arc =
      0;  ///< m from points[0] along the polyline at time 0; it sets out towards the last point
};

/// Owns nothing and remembers nothing: the owner may change or move the arrays between two ticks.
struct WorldView {
  const Disc* discs = nullptr;
  size_t disc_count = 0;
  const Segment* segments = nullptr;
  size_t segment_count = 0;
  const MovingDisc* movers = nullptr;
  size_t mover_count = 0;
};

/// The mover's centre at time t, s, in closed form.
Vec2 position(const MovingDisc& mover, double t);

/// The fastest mover's speed, m/s; 0 without movers.
double fastest_mover(const WorldView& world);

/// The gap between a disc body at p and the nearest obstacle at time t, m: negative when they overlap,
/// infinite in an empty world. A disc's inside counts as solid; a polygon's must be told by contains().
double clearance(const WorldView& world, Vec2 p, double t, double body_radius);

}  // namespace whisker::sim
