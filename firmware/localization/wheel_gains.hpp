/// How the wheels really turn the body, learned from headings.
#pragma once

#include <stdint.h>

#include "firmware/localization/odometry.hpp"
#include "firmware/math/angle.hpp"
#include "firmware/params.hpp"

namespace whisker::localization {

/// Beyond what the parameters say of the wheels, the body is turned by the difference of counts
///   gain * (right - left) + skew * (right + left)
/// with a gain for the track and the common scale, and a skew for unequal wheels. Both are learned, from a
/// gyro on stretches that begin and end without turning, so that its latency does not matter. What is used of
/// them stays within three of the standard deviations that the parameters declare: nothing that was wrong
/// while they were learned turns the body by more. If none is declared, nothing is used.
class WheelGains {
 public:
  void configure(const Params& params, const Odometry& odometry) noexcept;
  /// The declared standard deviations hold before the first stretch, too, instead of 3 % and 2 %.
  void expect_declared() noexcept;
  /// An error of the wheels is declared.
  bool declared() const noexcept { return most_gain_ != 0; }
  bool learned() const noexcept { return (gain_ | skew_) != 0; }

  /// That difference for this step, in 2^-12 counts.
  int32_t difference(const CountStep& step) const noexcept;
  /// Once per step: the turn by the gyro, and by the parameters. True: a stretch has ended on which a wheel
  /// must have slipped; it teaches nothing.
  bool compare(const CountStep& step, Angle gyro, Angle nominal) noexcept;
  struct Stretch {
    int32_t way = 0;    ///< counts of both wheels
    int32_t turn = 0;   ///< difference of the counts
    int32_t error = 0;  ///< true turn minus that by the parameters, 2^-32 turn
  };
  /// The stretch is long enough to teach.
  bool teaches(const Stretch& stretch) const noexcept;
  /// Learns from a stretch. noise: variance of its error besides that of the counts, see noise_of(). slip: in
  /// 2^-4 counts, and four standard deviations are no slip. True: a wheel must have slipped.
  bool observe(const Stretch& stretch, int64_t noise, int64_t slip) noexcept;
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

  int32_t most_gain_ = 0;  // 2^-24
  int32_t most_skew_ = 0;

  int32_t gain_ = 0;           // 2^-24
  int32_t skew_ = 0;           // 2^-24
  int32_t gain_variance_ = 0;  // 2^-32
  int32_t skew_variance_ = 0;

  Stretch now_;
  uint8_t straight_ = 0;
};

}  // namespace whisker::localization
