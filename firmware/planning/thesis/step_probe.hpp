/// Whether three beams leave room for a straight step.
#pragma once

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/echo.hpp"

namespace whisker::planning {

/// The swept area of a straight step is a stadium: all points within radius + margin of the way. An echo
/// says that something lies somewhere on an arc as wide as the cone; the step is free only if the arc's
/// point nearest to the way keeps out of the stadium, for every beam. A beam that is not usable is an
/// obstacle at the apex. What no cone covers (the flanks beyond side_angle + cone / 2, and gaps between
/// the cones) stays unproved; that is this rule's limit.
class StepProbe {
 public:
  void configure(const Params& params) noexcept;

  /// True if the body can drive `step` straight ahead of where it stood when it looked.
  bool free(const perception::Echoes& look, Length step) const noexcept;

 private:
  Length reach_;        // radius + margin
  Length side_apex_x_;  // of the side sensors' apexes, ahead
  Length side_apex_y_;  // and to their own side
  Length front_apex_;
  Q30 inner_cos_;  // of the side cones' edge that is nearest to straight ahead
  Q30 inner_sin_;
};

}  // namespace whisker::planning
