/// How the wheels really turn the body, learned from the gyro.
#pragma once

#include <stdint.h>

#include "firmware/localization/odometry.hpp"
#include "firmware/math/angle.hpp"

namespace whisker::localization {

/// The difference of the counts that turns the body is
///   (1 + gain) * (right - left) + skew * (right + left)
/// with a gain for the track and the common scale, and a skew for unequal wheels. Both are learned on
/// stretches that begin and end without turning, so that the latency of the gyro does not matter.
class WheelGains {
 public:
  /// counts_per_turn, and the skew before the first stretch: see Odometry.
  void configure(int32_t counts_per_turn, int32_t counts_per_metre, int32_t skew = 0) noexcept;

  /// Standard deviations before the first stretch, instead of 3 % and 2 %.
  void expect(Ratio gain, Ratio skew) noexcept;

  /// That difference for this step, in 2^-12 counts.
  int32_t difference(const CountStep& step) const noexcept;
  /// Once per step: the turn by the gyro and by the wheels. True: a stretch has ended on which a wheel must
  /// have slipped; it teaches nothing.
  bool compare(const CountStep& step, Angle gyro, Angle wheels) noexcept;
  struct Stretch {
    int32_t way = 0;    ///< counts of both wheels
    int32_t turn = 0;   ///< difference of the counts
    int32_t error = 0;  ///< true turn minus that by difference(), 2^-32 turn
  };
  /// The stretch is long enough to teach.
  bool teaches(int32_t way, int32_t turn) const noexcept;
  /// Learns from a stretch. noise: variance of its error besides that of the counts, see noise_of(). True: a
  /// wheel must have slipped.
  bool observe(const Stretch& stretch, int64_t noise) noexcept;
  /// The variance of an error with this standard deviation, 2^-8 square counts.
  int64_t noise_of(Angle sigma) const noexcept;
  /// The standard deviation of the skew.
  Ratio skew_sigma() const noexcept;
  /// The gyro missed a part of this stretch.
  void drop() noexcept;

 private:
  bool finish() noexcept;
  int64_t counts_of(int32_t turn) const noexcept;

  int32_t counts_per_turn_ = 0;
  int32_t least_way_ = 0;   // counts of both wheels on a stretch
  int32_t least_turn_ = 0;  // difference of counts on a stretch

  int32_t gain_ = 0;           // 2^-24
  int32_t skew_ = 0;           // 2^-24
  int32_t gain_variance_ = 0;  // 2^-32
  int32_t skew_variance_ = 0;

  Stretch now_;
  uint8_t straight_ = 0;
};

}  // namespace whisker::localization
