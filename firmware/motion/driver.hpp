/// Executes one manoeuvre as wheel speeds, tick by tick.
#pragma once

#include <stdint.h>

#include "firmware/core/trig.hpp"
#include "firmware/core/units.hpp"
#include "firmware/motion/mixer.hpp"
#include "firmware/motion/odometry.hpp"
#include "firmware/motion/shield.hpp"
#include "firmware/nav/manoeuvre.hpp"
#include "firmware/params.hpp"

namespace whisker::motion {

/// Braking is part of every tick: the speed is never more than what the acceleration limit can take off
/// over the way that is left, less what the motor's lag adds.
class Driver {
 public:
  /// Starts a manoeuvre; nav::Kind::keep changes nothing. The wheels go over from their present speeds.
  void begin(const nav::Manoeuvre& manoeuvre, const Pose& pose) noexcept;

  /// One control tick. counts == nullptr: none came, so nothing says that the body stands.
  /// paused: come to rest, and take the manoeuvre up again afterwards.
  /// Returns the new wheel speeds, at most max_acceleration x period from the ones before.
  WheelPair step(const Pose& pose, const CountStep* counts, bool paused, const Params& params) noexcept;

  /// The manoeuvre is over and the counts have stood still for three ticks.
  bool settled() const noexcept { return finished_ && still_ticks_ >= kStillTicks; }
  /// The wheels stand, whatever was commanded last: the drive refused. The manoeuvre goes on from there.
  void halt() noexcept { speeds_ = {}; }
  WheelState wheels() const noexcept { return {speeds_, rolling_}; }
  /// Ticks in a row for which the wheels were commanded to move and no count came.
  int32_t stalled_ticks() const noexcept { return stalled_ticks_; }
  /// Ticks, pauses left out, since the manoeuvre last came nearer to its end; after its end, ticks for which
  /// the wheels were commanded to stand and the body did not.
  int32_t waiting_ticks() const noexcept { return waiting_ticks_; }

 private:
  static constexpr int32_t kStillTicks = 3;
  WheelPair target(const Pose& pose, const Params& params) noexcept;
  void approach(Length rest) noexcept;

  nav::Manoeuvre current_{nav::Kind::stop, {}, {}};
  Vec origin_;
  WheelPair speeds_;
  WheelPair rolling_;  // the speeds behind the motors' lag
  bool finished_ = true;
  int32_t still_ticks_ = 0;
  int32_t stalled_ticks_ = 0;
  int32_t waiting_ticks_ = 0;
  Length nearest_;  // the smallest rest of this manoeuvre so far
};

}  // namespace whisker::motion
