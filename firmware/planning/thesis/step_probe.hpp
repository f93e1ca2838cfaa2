/// Tests whether the echoes of three beams leave room for a straight step.
#pragma once

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/echo.hpp"

namespace whisker::planning {

/// The swept area of a straight step is a stadium: all points within radius + margin of the path. An echo
/// means that something lies somewhere on an arc as wide as the cone. The step is free only if, for every
/// beam, the point of the arc nearest to the path is outside the stadium. An unusable beam counts as an
/// obstacle at the apex. The test does not cover ground outside the cones: the flanks beyond side_angle +
/// cone / 2, and gaps between the cones.
class StepProbe {
 public:
  void configure(const Params& params) noexcept;

  /// True if the body can drive `step` straight ahead from the place of the scan.
  bool free(const perception::Echoes& look, Length step) const noexcept;

 private:
  Length reach_;        // radius + margin
  Length side_apex_x_;  // of the side sensors, ahead
  Length side_apex_y_;  // and to their own side
  Length front_apex_;
  Q30 inner_cos_;  // of the edge of the side cones nearest to straight ahead
  Q30 inner_sin_;
};

}  // namespace whisker::planning
