/// How far the pose estimate may be off: standard deviations, from those of the wheels and the gyro.
#pragma once

#include <stdint.h>

#include "firmware/localization/bias_filter.hpp"
#include "firmware/localization/gyro_bias.hpp"
#include "firmware/localization/odometry.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"

namespace whisker::localization {

/// Standard deviations of a pose: along the heading, across it, and of the heading.
struct PoseSigma {
  Length along;
  Length across;
  Angle heading;  ///< at most a quarter turn
};

/// Twice the root of the mean square of the distance from the true position (2 DRMS). Between 95.4 and 98.2 %
/// of normally distributed errors are smaller.
Length distance_bound(const PoseSigma& sigma) noexcept;

/// Propagates the error of the pose.
///
/// Errors that last (scale of the wheels, their difference, scale of the gyro) are one unknown number each.
/// For each, `Lasting` is the error of the pose that one standard deviation has caused so far. Errors that do
/// not last make the heading a random walk, whose covariance with the position is propagated. The bias of the
/// gyro has a filter of its own, which adds to that. The sum is the covariance of the pose. Sigmas saturate
/// at kMost.
class PoseBound {
 public:
  static constexpr Length kMost = 16_m;
  /// A measurement is a jump if it differs by more than this many standard deviations of the difference.
  static constexpr int32_t kJumpSigmas = 4;
  /// Ticks between two updates.
  static constexpr uint8_t kEvery = 8;
  static constexpr int64_t kDoubtful = 30144082;  ///< the square of 0.3 degrees: rad^2 2^-40

  struct Step {
    Pose pose;  ///< after the step
    CountStep counts;
    Duration elapsed;
    bool by_gyro = false;  ///< the gyro turned the pose
  };

  void configure(const Params& params) noexcept;
  /// False: the parameters declare no error of the wheels, so there is no bound.
  bool known() const noexcept { return known_; }
  /// The wheels were taught: from now on, the difference of their errors has at most this standard deviation.
  void set_difference(Ratio sigma, Length track) noexcept;
  /// The body is at this pose, known with this accuracy.
  void restart(const Pose& pose, const PoseSigma& sigma) noexcept;
  /// Once per tick. True: sigma() has changed. Unless known(), only the filter of the bias advances.
  bool step(const Step& step) noexcept;
  PoseSigma sigma() const noexcept;
  /// The variance of the heading is above kDoubtful, without errors that have lasted since the last measured
  /// heading. False unless known().
  bool heading_wanders() const noexcept { return known_ && heading_ > kDoubtful; }

  /// What a measured heading says of the pose in the frame of step().
  struct Correction {
    Vec shift;
    Angle turn;
  };
  /// The heading is measured: by so much the true one is ahead, with this standard deviation, above zero. The
  /// place is corrected, too, as far as its error comes from that of the heading (Kalman filter). False:
  /// `ahead` is more than kJumpSigmas off, and nothing has changed.
  bool correct_heading(Angle ahead, Angle sigma, Correction& out) noexcept;
  /// The gyro was at rest. Corrects its bias, and returns what that says of the pose.
  Correction rest(const GyroBias::Mean& mean, const Params& params, GyroBias& bias) noexcept;

 private:
  struct Place {
    int32_t x = 0;  // 2^-4 um
    int32_t y = 0;
  };
  struct Lasting : Place {
    int32_t heading = 0;  // 2^-28 rad
  };
  enum : uint8_t { kScale, kDifference, kGyroScale, kLastings };
  void shorten(int32_t x, int32_t y) noexcept;
  int64_t heading_variance() const noexcept;
  void gather() noexcept;

  void update(const Step& step, bool moved) noexcept;
  void walk(int32_t x, int32_t y, int64_t by) noexcept;

  BiasFilter bias_;
  Lasting lasting_[kLastings];
  Place shortened_;     // by the square of the error of the heading
  int32_t counts_ = 0;  // of both wheels, signed
  // The covariance of the rest: rad^2 2^-40, um rad 2^-20, um^2.
  int64_t heading_ = 0;
  int64_t x_heading_ = 0;
  int64_t y_heading_ = 0;
  int64_t xx_ = 0;
  int64_t xy_ = 0;
  int64_t yy_ = 0;

  Pose last_;
  uint16_t elapsed_ms_ = 0;  // at most kLongest
  uint8_t ticks_ = 0;
  bool known_ = false;

  int32_t um_per_counts_ = 0;  // both wheels, 2^-16 um
  int32_t scale_ = 0;          // 2^-30
  int32_t turn_per_um_ = 0;    // by the difference of the wheels, 2^-44 rad
  int32_t gyro_scale_ = 0;     // 2^-30
  int32_t walk_per_um_ = 0;    // of the wheels, 2^-56 rad^2
  int32_t walk_per_ms_ = 0;    // of the gyro, 2^-56 rad^2
};

}  // namespace whisker::localization
