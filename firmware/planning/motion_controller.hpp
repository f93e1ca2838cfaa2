/// Turns the manoeuvre under way into the velocities of a tick.
#pragma once

#include <stdint.h>

#include "firmware/localization/odometry.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/planning/manoeuvre.hpp"

namespace whisker::planning {

/// Braking is part of every tick: the speed is never more than what the acceleration limit can take off
/// over the way that is left, less what the motor's lag adds.
class MotionController {
 public:
  /// Starts a manoeuvre; ManoeuvreKind::keep changes nothing.
  void begin(const Manoeuvre& manoeuvre, const Pose& pose) noexcept;

  /// Once a tick, unless the robot must stand. `elapsed` since the tick before; `held_for`: how long the
  /// guard has let nothing through. A drive that is held for longer than kHeld ends there: see cut().
  VelocityRequest request(const Pose& pose, Duration elapsed, Duration held_for,
                          const Params& params) noexcept;

  /// Once a tick, after request(). counts == nullptr: none came, so nothing says that the body stands.
  /// `commanded`: a wheel is commanded to turn.
  void settle(const localization::CountStep* counts, bool commanded, Duration elapsed,
              const Params& params) noexcept;

  /// The manoeuvre is over and the counts have stood still for three periods.
  bool settled() const noexcept { return settled_; }
  /// The guard ended the last drive before its length.
  bool cut() const noexcept { return cut_; }
  /// For how long the wheels have been commanded to move and no count came.
  Duration stalled_for() const noexcept { return stalled_for_; }
  /// How long ago, pauses left out, the manoeuvre last came nearer to its end; after its end, for how long
  /// the wheels have been commanded to stand and the body did not.
  Duration waiting_for() const noexcept { return waiting_for_; }

 private:
  VelocityRequest cruise(const Params& params) const noexcept;
  VelocityRequest turn(Angle error, Duration elapsed, const Params& params) noexcept;
  VelocityRequest drive(const Pose& pose, Angle error, Duration elapsed, const Params& params) noexcept;
  void approach(Length rest, Duration elapsed) noexcept;

  Manoeuvre current_{ManoeuvreKind::stop, {}, {}, {}, {}};
  Vec origin_;
  bool finished_ = true;
  bool cut_ = false;
  bool settled_ = false;
  Duration still_for_;
  Duration stalled_for_;
  Duration waiting_for_;
  Length nearest_;  // the smallest rest of this manoeuvre so far
};

}  // namespace whisker::planning
