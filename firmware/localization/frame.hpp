/// From where the wheels' counts put the body to where its user does.
#pragma once

#include "firmware/math/region.hpp"
#include "firmware/math/trig.hpp"

namespace whisker::localization {

/// The robot's own places (ground, map) are the odometry's, which never jump. A correction of the pose moves
/// this frame, so that they stay where they are around the body; the user's goal then lies elsewhere among
/// them.
class Frame {
 public:
  /// The body is `inside` by the odometry, and `outside` by its user. Between the ties nothing adds up.
  void tie(const Pose& inside, const Pose& outside) noexcept;
  Pose outward(const Pose& inside) const noexcept;
  /// Where that goal of the user's lies by the odometry; off by at most 20 um at 1,000 m from the last tie.
  /// False: it is out of range.
  bool aim(Vec goal, Vec& inside) noexcept;
  /// The same of the goal before, after another tie.
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
