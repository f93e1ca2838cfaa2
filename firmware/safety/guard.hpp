/// Lets through only wheel speeds that end in a stop on clear ground.
#pragma once

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"
#include "firmware/planning/manoeuvre.hpp"

namespace whisker::safety {

/// The last stage before the wheels: nothing else decides how fast they turn.
///
/// It tries a few fractions of the forward speed that is asked for, beside the rims' speed of turning, and
/// grants the largest whose braking arc, after the longest gap that may pass before the next tick, brings the
/// disc of Reach::guard no nearer to a cell that is not clear. If there is none, both wheels brake in
/// proportion, along the arc that was found free a tick before.
class Guard {
 public:
  void reset() noexcept { *this = Guard{}; }

  /// Once a tick: the wheel speeds to command. They were judged as they are, with the acceleration limit over
  /// `elapsed`, the time since the last tick.
  WheelPair step(const planning::VelocityRequest& request, const Pose& pose, const WheelState& wheels,
                 const perception::LocalGrid& grid, Duration elapsed, const Params& params) noexcept;

  /// Part of the last forward speed asked for that was granted; zero where it only brakes.
  Q14 granted() const noexcept { return granted_; }
  /// For how long it has granted nothing of a request to drive.
  Duration held_for() const noexcept { return held_for_; }

 private:
  Q14 granted_;
  Duration held_for_;
};

}  // namespace whisker::safety
