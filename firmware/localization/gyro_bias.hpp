/// The bias of the gyro, measured while the robot stands.
#pragma once

#include <stdint.h>

#include "firmware/math/units.hpp"
#include "firmware/params.hpp"

namespace whisker::localization {

/// The rate at which a sample has its largest value, with the scale that the gyro has: urad/s.
int32_t scaled_range(const GyroParams& params) noexcept;
/// The rate that a sample of so much (2^-16 of its unit) means: 2^-24 rad/s.
int32_t rate_of(int32_t sample, const GyroParams& params) noexcept;

/// A rest counts from kWait (more with a slow motor or coarse counts) after the last encoder count on: until
/// then the body may still move.
///
/// The first measurement takes kFirstRest. Later, a rest of kRest serves for kServes, in which the bias of a
/// gyro that warms up changes noticeably. In doubt, one of kRestInDoubt serves for kServesInDoubt. In
/// between, the value follows the change that was learned.
class GyroBias {
 public:
  static constexpr Duration kWait = 150_ms;
  static constexpr Duration kFirstRest = 2000_ms;
  static constexpr Duration kRest = 1000_ms;
  static constexpr Duration kServes = 60000_ms;
  static constexpr Duration kRestInDoubt = 3000_ms;
  static constexpr Duration kServesInDoubt = 30000_ms;

  void configure(const Params& params) noexcept;
  /// Once per step. `still`: no counts, and no wheel is commanded to turn.
  void pass(bool still, Duration elapsed) noexcept;
  /// No counts and no command at this step.
  bool stands() const noexcept { return still_for_ > Duration{}; }
  /// The body rests, so samples measure the bias.
  bool rests() const noexcept { return still_for_ > wait_; }
  /// Adds samples of a rest. False: their rate is more than 1 % of the range off the bias; something turns
  /// the body.
  bool add(int32_t sum, int32_t samples) noexcept;

  /// A mean of samples at rest.
  struct Mean {
    int32_t off = 0;      ///< measured less value(), 2^-16 units of a sample
    int32_t off_rad = 0;  ///< the same, 2^-24 rad/s
    Duration lasted;
    bool first = false;  ///< the bias was not known before; nothing is off
  };
  /// True: kRest has passed, or a shorter rest has ended; once for each.
  bool take(const GyroParams& params, Mean& mean) noexcept;
  /// Of what was off, by these shares: the bias (2^-16), and its change per ms (2^-32).
  void learn(int32_t off, int32_t bias, int32_t change) noexcept;

  bool known() const noexcept { return known_; }
  /// A rest is needed.
  bool due() const noexcept { return due_for() > Duration{}; }
  /// How long it has been needed; negative before.
  Duration due_for() const noexcept { return used_for_ - (in_doubt_ ? kServesInDoubt : kServes); }
  /// It may have turned the heading so far that it needs longer and more frequent rests.
  void doubt(bool is) noexcept { in_doubt_ = is; }
  /// The body does not come to rest for long enough: try again as after a rest.
  void postpone() noexcept { used_for_ = Duration{}; }
  /// Of one sample, 2^-16 of its unit.
  int32_t value() const noexcept;

 private:
  int32_t value_ = 0;   // when it was measured
  int32_t change_ = 0;  // since then, 2^-16 of its unit per ms
  int32_t sum_ = 0;     // of samples that are not yet taken
  Duration measured_for_;
  Duration still_for_;
  Duration wait_ = kWait;
  Duration used_for_ = kServes + 1_ms;  // since the last long rest
  uint16_t samples_ = 0;                // that are in the sum
  bool known_ = false;
  bool in_doubt_ = false;
};

}  // namespace whisker::localization
