/// Where the body goes after a command, until it stands.
#pragma once

#include <stdint.h>

#include "firmware/math/units.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "firmware/params.hpp"

namespace whisker::safety {

/// How far both wheels roll on one arc.
struct Arc {
  Length left;
  Length right;
  Length length() const noexcept { return (left + right) / 2; }
  /// Of the body, 2^-32 turn; it may be more than one.
  int64_t turn(Length track) const noexcept;
};

/// The way of the body if no other command follows: each wheel leaves the speed at which it rolls with the
/// motor's lag, holds the commanded one until the latest next tick, and then brakes, both in the same time.
///
/// The speed at which a wheel rolls takes it on for the lag, the commanded one for the hold and half of the
/// braking. So the length of the way is exact. Its shape is one arc if both speeds turn alike. A way that one
/// arc would miss by more than `allowed` is divided, each piece over a part of the lag.
class Coasting {
 public:
  Coasting(WheelPair command, const WheelState& wheels, const Params& params, Length allowed) noexcept;

  /// The next piece of the way. False: the body stands.
  bool next(Arc& piece) noexcept;

 private:
  int64_t speed_integral(int32_t until_us) const noexcept;
  int32_t divisor(Length track, Length allowed) const noexcept;
  int64_t bend_um(Length track) const noexcept;
  Length overshoot() const noexcept;

  WheelPair command_;
  WheelPair rolling_;
  int32_t lag_us_;
  int32_t hold_us_;
  int32_t braking_us_;
  int32_t step_us_ = 0;
  int32_t fades_ = 0;  // share of the difference to the command that a step takes, 2^-16
  int32_t left_ = 1;   // pieces
  int32_t now_us_ = 0;
  int32_t rolls_ = 65536;  // share of its first speed, and of the commanded one, 2^-16
  int32_t follows_ = 0;
};

}  // namespace whisker::safety
