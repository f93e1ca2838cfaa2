/// Teaches the wheels by the headings of fixes.
#pragma once

#include <stdint.h>

#include "firmware/localization/odometry.hpp"
#include "firmware/localization/wheel_gains.hpp"
#include "firmware/params.hpp"

namespace whisker::localization {

/// For a robot without a gyro that declares an error of its wheels. Between two fixes, the wheels and the
/// fixes turn the body by different angles; the difference teaches how the wheels turn it. A fix may be
/// wrong, so this turns the user's frame only, never that of the odometry.
class FixTeacher {
 public:
  void configure(const Params& params, const Odometry& odometry) noexcept;
  /// The next fix is the first one again: it teaches nothing. What was learned stays.
  void restart() noexcept;
  /// A fix says how far the true heading is ahead of that of the odometry, with this standard deviation.
  /// True: it was a lesson. Without a way long enough for one, the earlier fix stays the one to compare with.
  bool fix(Angle offset, Angle sigma) noexcept;
  /// Once per step. By how much the wheels turn the body beyond what the odometry counts, given in portions;
  /// mostly zero.
  Angle pass(const CountStep& step, const Odometry& odometry) noexcept;

  const WheelGains& gains() const noexcept { return gains_; }

 private:
  WheelGains gains_;
  WheelGains::Stretch since_;  // the earlier fix
  Angle offset_;               // by it
  Angle sigma_;
  Angle ahead_;  // not yet given by pass()
  bool has_fix_ = false;
};

}  // namespace whisker::localization
