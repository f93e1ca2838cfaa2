/// The surroundings of the robot: a view of arrays that the caller owns.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "host/harness/sim/geometry.hpp"

namespace whisker::sim {

/// A disc whose centre moves along a polyline and back at constant speed.
struct MovingDisc {
  const Vec2* points = nullptr;
  size_t count = 0;      ///< at least 1
  double radius = 0;     ///< m
  double speed = 0;      ///< m/s, not negative
  double start_arc = 0;  ///< m from points[0] along the polyline at time 0; it starts towards the last point
};

/// Owns nothing and has no state: the owner may change or move the arrays between two ticks.
struct WorldView {
  const Disc* discs = nullptr;
  size_t disc_count = 0;
  const Segment* segments = nullptr;
  size_t segment_count = 0;
  const MovingDisc* movers = nullptr;
  size_t mover_count = 0;
  /// Not 0 for each obstacle that absorbs; discs, then movers, then segments. Null: none does.
  const uint8_t* soft = nullptr;
};

/// The centre of the mover at time t, s, in closed form.
Vec2 position(const MovingDisc& mover, double t);

/// The speed of the fastest mover, m/s; 0 without movers.
double fastest_mover(const WorldView& world);

/// The gap between a disc body at p and the nearest obstacle at time t, m: negative if they overlap, infinite
/// in an empty world. The inside of a disc is solid; for a polygon, use contains().
double clearance(const WorldView& world, Vec2 p, double t, double body_radius);

}  // namespace whisker::sim
