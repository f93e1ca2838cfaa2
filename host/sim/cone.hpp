/// The view of a rangefinder: the exact distance to the nearest point of an obstacle within a cone.
#pragma once

#include "host/sim/geometry.hpp"
#include "host/sim/world.hpp"

namespace whisker::sim {

/// All points within the half width of the axis, including the edges. A point within kConeSlack of an edge
/// counts as inside, so that rounding loses no obstacle that passes through the apex or touches an edge.
struct Cone {
  Vec2 apex;
  Vec2 axis;        ///< unit vector
  double cos_half;  ///< of the half width, which is above 0 and below 90 degrees
  double sin_half;
};

constexpr double kConeSlack = 1e-12;  ///< m

/// Distance from the apex to the nearest point of the obstacle within the cone, m; 0 if the apex is inside
/// the disc or on the segment; infinite if the cone contains no point of it.
double range(const Cone& cone, const Disc& disc);
double range(const Cone& cone, const Segment& segment);

/// The smallest range over a world at time t, s; infinite if it is at least `limit`, m.
double range(const Cone& cone, const WorldView& world, double t, double limit);

}  // namespace whisker::sim
