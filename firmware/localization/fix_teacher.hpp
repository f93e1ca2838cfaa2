/// Teaches the wheels by the headings of fixes.
#pragma once

#include <stdint.h>

#include "firmware/localization/odometry.hpp"
#include "firmware/localization/wheel_gains.hpp"
#include "firmware/params.hpp"

namespace whisker::localization {

/// For a robot without a gyro. Between two fixes, the wheels and the fixes turn the body by different angles;
/// the difference teaches how the wheels turn it. After the first lesson, turn() replaces the nominal turn.
class FixTeacher {
 public:
  void configure(const Params& params, const Odometry& odometry) noexcept;
  /// The true heading is believed to be this far ahead of that of the odometry, with this standard deviation.
  void restart(Angle offset, Angle sigma) noexcept;
  /// A fix says how far the true heading is ahead. True: the way since restart() was long enough for a
  /// lesson; call restart() then.
  bool fix(Angle offset, Angle sigma) noexcept;
  void pass(const CountStep& step) noexcept;

  bool taught() const noexcept { return taught_; }
  /// By the wheels as taught.
  Angle turn(const CountStep& step, const Odometry& odometry) const noexcept {
    return odometry.turn_of(gains_.difference(step));
  }
  const WheelGains& gains() const noexcept { return gains_; }

 private:
  WheelGains gains_;
  int32_t way_ = 0;   // counts of both wheels since the last fix
  int32_t turn_ = 0;  // their difference
  Angle offset_;
  Angle sigma_;
  bool taught_ = false;
};

}  // namespace whisker::localization
