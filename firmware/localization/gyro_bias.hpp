/// The bias of the gyro, measured while the robot stands.
#pragma once

#include <stdint.h>

#include "firmware/math/units.hpp"
#include "firmware/params.hpp"

namespace whisker::localization {

/// A rest counts from kWait after the last encoder count on: until then the body may still move.
///
/// The first measurement takes kFirstRest. Later, a rest of kRest serves for kServes, in which the bias of a
/// gyro that warms up changes noticeably.
class GyroBias {
 public:
  static constexpr Duration kWait = 150_ms;
  static constexpr Duration kFirstRest = 2000_ms;
  static constexpr Duration kRest = 1000_ms;
  static constexpr Duration kServes = 60000_ms;

  void configure(const GyroParams& params) noexcept { rate_hz_ = params.rate_hz; }

  /// Once per step. `still`: no counts, and no wheel is commanded to turn.
  void pass(bool still, Duration elapsed) noexcept;
  /// No counts and no command at this step.
  bool stands() const noexcept { return still_for_ > Duration{}; }
  /// The body rests, so samples measure the bias.
  bool rests() const noexcept { return still_for_ > kWait; }
  /// Adds samples of a rest. False: their rate is more than 1 % of the range off the bias; something turns
  /// the body.
  bool add(int32_t sum, int32_t samples) noexcept;

  bool known() const noexcept { return known_; }
  /// A rest is needed.
  bool due() const noexcept { return due_for() > Duration{}; }
  /// How long it has been needed; negative before.
  Duration due_for() const noexcept { return used_for_ - kServes; }
  /// The body does not come to rest: try again after kServes.
  void postpone() noexcept { used_for_ = Duration{}; }
  /// Since the last long rest.
  Duration age() const noexcept { return used_for_; }
  /// Of one sample, 2^-16 of its unit.
  int32_t value() const noexcept { return value_; }

 private:
  int32_t value_ = 0;
  int32_t rate_hz_ = 100;
  int32_t weight_ = 0;  // samples in the mean
  int32_t rested_ = 0;  // samples of this rest
  Duration still_for_;
  Duration used_for_ = kServes + 1_ms;  // since the last long rest
  bool known_ = false;
};

}  // namespace whisker::localization
