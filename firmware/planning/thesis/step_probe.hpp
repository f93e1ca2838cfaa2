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
  struct Inner {
    Vec apex;  // y: to the side to which the beam points
    Q30 cos;   // of the direction in the cone nearest to straight ahead
    Q30 sin;
    Q30 beyond;  // sine of the angle by which the cone extends beyond straight ahead
  };
  Length reach_;  // radius + margin
  Inner beam_[hal::kBeams];
};

}  // namespace whisker::planning
