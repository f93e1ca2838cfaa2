/// The view of a rangefinder: the exact distance to the nearest point of an obstacle within a cone.
#pragma once

#include "host/harness/sim/geometry.hpp"
#include "host/harness/sim/world.hpp"

namespace whisker::sim {

constexpr double kConeSlack = 1e-12;  ///< m
constexpr double kScatter = 0.5;      ///< m

/// All points within the half width of the axis, including the edges. A point within kConeSlack of an edge
/// counts as inside, so that rounding loses no obstacle that passes through the apex or touches an edge.
struct Cone {
  Vec2 apex;
  Vec2 axis;        ///< unit vector
  double cos_half;  ///< of the half width, which is above 0 and below 90 degrees
  double sin_half;
  /// Sine of the largest angle between a ray and the normal of a surface that still gives an echo; from 1 on,
  /// every surface does.
  double sin_incidence = 1;
  /// Up to this distance, m, the end of a segment scatters: it gives an echo at any angle.
  double scatter = kScatter;
};

/// Distance from the apex to the nearest point of the obstacle within the cone that gives an echo, m; 0 if
/// the apex is inside the disc or on the segment; infinite if the cone contains no such point of it.
double range(const Cone& cone, const Disc& disc);
double range(const Cone& cone, const Segment& segment);

/// The smallest range over a world at time t, s; infinite if it is at least `limit`, m. An obstacle that
/// absorbs (WorldView::soft) counts only if it is nearer than `soft_limit`, m.
double range(const Cone& cone, const WorldView& world, double t, double limit,
             double soft_limit = __builtin_huge_val());

}  // namespace whisker::sim
