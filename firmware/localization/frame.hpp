/// Transform between the odometry frame and the user's frame.
#pragma once

#include "firmware/math/region.hpp"
#include "firmware/math/trig.hpp"

namespace whisker::localization {

/// Local grid and map use the odometry frame, which never jumps. A correction of the pose changes this
/// transform, so they stay in place around the body, and the user's goal moves in the odometry frame.
class Frame {
 public:
  /// The body is at `inside` in the odometry frame and at `outside` in the user's frame. Errors do not
  /// accumulate between calls.
  void tie(const Pose& inside, const Pose& outside) noexcept;
  Pose outward(const Pose& inside) const noexcept;
  /// The user's goal in the odometry frame; error at most 20 um at 1,000 m from the last tie. False: it is
  /// out of range.
  bool aim(Vec goal, Vec& inside) noexcept;
  /// The same for the current goal after another tie.
  bool aim_again(Vec& inside) noexcept { return aim(goal_, inside); }

 private:
  Vec goal_;
  Vec inside_;
  Vec outside_;
  Angle turn_;
  Q30 cos_ = Q30::from_raw(Q30::kOne);
  Q30 sin_;
};

}  // namespace whisker::localization
