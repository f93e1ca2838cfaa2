/// Passes only wheel speeds that end in a stop on clear ground.
#pragma once

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"
#include "firmware/planning/manoeuvre.hpp"

namespace whisker::safety {

/// The core of the guard, the last stage before the wheels: it alone decides their speeds.
///
/// It tries fractions of the requested forward speed together with the rim speed of turning. It grants
/// the largest one whose braking arc, after the longest gap before the next tick, brings the disc of
/// Reach::guard no nearer to a cell that is not clear. If there is none, both wheels brake in proportion
/// along the arc that was found free one tick before.
///
/// With BumperParams::creep_speed, it then tries that forward speed, if it is less than the requested one,
/// over ground that is not clear but holds no suspect cell.
class SpeedLimiter {
 public:
  void reset() noexcept { *this = SpeedLimiter{}; }

  /// Call once per tick. Returns the wheel speeds to command, exactly as checked, within the acceleration
  /// limit over `elapsed`, the time since the last tick.
  WheelPair step(const planning::VelocityRequest& request, const Pose& pose, const WheelState& wheels,
                 const perception::LocalGrid& grid, Duration elapsed, const Params& params) noexcept;

  /// Stands at once, without a ramp. Instead of step().
  WheelPair stop() noexcept {
    reset();
    return {};
  }

  /// Over ground that the body has covered just before. It needs no check. Instead of step().
  WheelPair retrace(const planning::VelocityRequest& request, const WheelState& wheels, Duration elapsed,
                    const Params& params) noexcept;

  /// Granted fraction of the last requested forward speed; zero if it only brakes. Creeping counts.
  Q14 granted() const noexcept { return granted_; }
  /// It found no way that is free: it follows the last one to its end.
  bool brakes() const noexcept { return brakes_; }
  /// How long it has granted nothing of a request to drive.
  Duration held_for() const noexcept { return held_for_; }

 private:
  Q14 granted_;
  Duration held_for_;
  bool brakes_ = true;
};

}  // namespace whisker::safety
