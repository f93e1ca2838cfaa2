/// Checks that the body moves at all.
#pragma once

#include "firmware/localization/odometry.hpp"
#include "firmware/math/units.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "firmware/params.hpp"

namespace whisker::safety {

/// Finds both wheels held, which WheelWatch cannot judge: commanded to turn, but no wheel counts for
/// derived::stalled_after(), and a wheel has missed ten counts. A command to turn by less than a count, or
/// to and fro, moves the body without a count, so that the time alone says nothing.
class StallWatch {
 public:
  void reset() noexcept { *this = StallWatch{}; }
  /// Call once per step of the counts. `commanded`: a wheel was sent a speed; by the model of the motors,
  /// they turn at `rolling` now.
  bool stalled(const localization::CountStep& counts, bool commanded, WheelPair rolling, Duration elapsed,
               const Params& params) noexcept;

 private:
  Duration for_;
  Length missing_[2];  // signed way of each wheel without a count
};

}  // namespace whisker::safety
