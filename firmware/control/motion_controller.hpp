/// Executes one manoeuvre as wheel speeds, tick by tick.
#pragma once

#include <stdint.h>

#include "firmware/localization/odometry.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "firmware/params.hpp"
#include "firmware/planning/manoeuvre.hpp"
#include "hal/types.hpp"

namespace whisker::control {

/// Braking is part of every tick: the speed is never more than what the acceleration limit can take off
/// over the way that is left, less what the motor's lag adds.
class MotionController {
 public:
  /// Starts a manoeuvre; ManoeuvreKind::keep changes nothing. The wheels go over from their present speeds.
  void begin(const planning::Manoeuvre& manoeuvre, const Pose& pose) noexcept;

  /// One control tick. counts == nullptr: none came, so nothing says that the body stands.
  /// paused: come to rest, and take the manoeuvre up again afterwards.
  /// elapsed: since the tick before.
  /// Returns the new wheel speeds, at most max_acceleration x elapsed from the ones before.
  WheelPair step(const Pose& pose, const localization::CountStep* counts, bool paused, Duration elapsed,
                 const Params& params) noexcept;

  /// The manoeuvre is over and the counts have stood still for three periods.
  bool settled() const noexcept { return settled_; }
  /// The wheels stand, whatever was commanded last: the drive refused. The manoeuvre goes on from there.
  void halt() noexcept { speeds_ = {}; }
  WheelState wheels() const noexcept { return {speeds_, rolling_}; }
  /// For how long the wheels have been commanded to move and no count came.
  Duration stalled_for() const noexcept { return stalled_for_; }
  /// How long ago, pauses left out, the manoeuvre last came nearer to its end; after its end, for how long
  /// the wheels have been commanded to stand and the body did not.
  Duration waiting_for() const noexcept { return waiting_for_; }

 private:
  WheelPair target(const Pose& pose, Duration elapsed, const Params& params) noexcept;
  void approach(Length rest, Duration elapsed) noexcept;

  planning::Manoeuvre current_{planning::ManoeuvreKind::stop, {}, {}};
  Vec origin_;
  WheelPair speeds_;
  WheelPair rolling_;  // the speeds behind the motors' lag
  bool finished_ = true;
  bool settled_ = false;
  Duration still_for_;
  Duration stalled_for_;
  Duration waiting_for_;
  Length nearest_;  // the smallest rest of this manoeuvre so far
};

/// To the wire's 0.1 mm/s, to nearest; saturates.
hal::WheelSpeeds to_wire(WheelPair speeds) noexcept;

}  // namespace whisker::control
