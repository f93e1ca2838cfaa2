/// A rangefinder's view: the exact distance to the nearest point of an obstacle within a cone.
#pragma once

#include "host/sim/geometry.hpp"
#include "host/sim/world.hpp"

namespace whisker::sim {

/// All points within the half width of the axis, edges included. A point within kConeSlack of an edge counts
/// as inside, so that an obstacle through the apex or just touching an edge is not lost to rounding.
struct Cone {
  Vec2 apex;
  Vec2 axis;        ///< unit vector
  double cos_half;  ///< of the half width, which lies above 0 and below 90 degrees
  double sin_half;
};

constexpr double kConeSlack = 1e-12;  ///< m

/// Distance from the apex to the nearest point of the obstacle within the cone, m; 0 with the apex inside the
/// disc or on the segment; infinite if the cone holds no point of it.
double range(const Cone& cone, const Disc& disc);
double range(const Cone& cone, const Segment& segment);

/// The smallest range over a world at time t, s; infinite if it is `limit` or more, m.
double range(const Cone& cone, const WorldView& world, double t, double limit);

}  // namespace whisker::sim
