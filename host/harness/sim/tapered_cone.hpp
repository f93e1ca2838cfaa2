/// The view of a rangefinder whose cone is narrower for far obstacles than for near ones.
#pragma once

#include "host/harness/sim/cone.hpp"
#include "host/harness/sim/elementary.hpp"

namespace whisker::sim {

/// All points at a distance d from the apex whose angle to the axis is at most half_width(d).
struct TaperedCone {
  /// half_width: rad, at the apex, above 0 and below pi / 2. far: rad, from 0 to half_width, from `reach` on.
  /// reach: m, above 0. The cone's width is ignored.
  TaperedCone(const Cone& cone, double half_width, double far, double reach);

  double half_width(double d) const { return d < reach ? near - (near - far) * (d / reach) : far; }

  Cone widest;  ///< at the apex
  double near;
  double far;
  double reach;
};

/// A point beyond the edge counts as inside up to this share of near - far.
constexpr double kTaperSlack = 1.0 / 4096;

/// The smallest range over a world at time t, s, as range() of a Cone: that of the nearest point within the
/// cone, whose edge has the slack kTaperSlack.
double range(const TaperedCone& cone, const WorldView& world, double t, double limit,
             double soft_limit = __builtin_huge_val());

}  // namespace whisker::sim
