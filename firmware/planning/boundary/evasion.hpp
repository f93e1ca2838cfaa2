/// Gets out of the way of what moves.
#pragma once

#include "firmware/params.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

/// Something that moves comes this way if the body is ahead of it and near the line of its motion. The body
/// then leaves that line by a heading that is free, forwards or backwards, and stands beside it until the
/// object has passed, or has not been seen to move for three seconds.
///
/// The line bisects two directions: the measured one, and the one straight to the body. Cones are wide, so
/// the measured one alone may be wrong by 40 degrees.
class Evasion {
 public:
  void reset() noexcept { unseen_for_ = kForgotten; }
  /// Once per tick. True: something comes this way.
  bool threatened(const View& view, const Params& params) noexcept;
  /// Chooses the side of the line: the one on which the body is. After threatened().
  void begin() noexcept { left_ = aside_ > Length{}; }
  /// Once per tick after that.
  Manoeuvre step(const View& view, const Params& params) const noexcept;

 private:
  static constexpr Duration kForgotten = Duration::from_raw(3000);

  Vec at_;  // of the object, when last seen
  Angle direction_;
  Length aside_;  // of the body from the line, to its left
  Duration unseen_for_ = kForgotten;
  bool left_ = false;
};

}  // namespace whisker::planning
