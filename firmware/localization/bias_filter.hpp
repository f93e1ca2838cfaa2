/// What the bias of the gyro has done to the pose, and what a rest says of both.
#pragma once

#include <stdint.h>

#include "firmware/math/units.hpp"

namespace whisker::localization {

/// A Kalman filter of the error of the bias and of its change, with their covariance with the error of the
/// pose: who measures the bias corrects the pose, too, as far as the bias has moved it. The bias changes
/// steadily while the gyro warms up, and wanders besides. The numbers have a common unit of the bias, which
/// becomes coarser when one of them has no room.
class BiasFilter {
 public:
  struct Error {
    int32_t x, y;     ///< um
    int32_t heading;  ///< 2^-20 rad
  };
  struct Learned {
    int32_t bias;    ///< share of what is off, 2^-16
    int32_t change;  ///< share of what is off per ms, 2^-32
    Error ahead;     ///< the true pose is ahead by so much
  };
  /// Covariances of a pose: rad^2 2^-40, um rad 2^-20, um^2.
  struct Covariance {
    int64_t heading, x_heading, y_heading, xx, xy, yy;
  };

  /// `change`: the standard deviation of the change of the bias, 2^-30 rad/s^2.
  void configure(int32_t change) noexcept;
  /// The bias is measured for the first time. `variance`, here and below: of what is measured, (rad/s)^2
  /// 2^-48, above zero.
  void begin(int64_t variance) noexcept;
  bool begun() const noexcept { return of_bias_[kBias] > 0; }
  /// The pose is measured: what the bias has done to it is known.
  void forget() noexcept;
  /// The body has moved by x, y (um, less than 2^21) in less than 2^15 ms. `by_gyro`: the gyro has turned it.
  /// Returns what the covariance of the pose grows by.
  Covariance step(int32_t x, int32_t y, Duration elapsed, bool by_gyro) noexcept;
  /// The mean of samples at rest is `off` (2^-24 rad/s) above what was expected. `shrinks`: what the
  /// covariance of the pose loses.
  Learned measure(int32_t off, int64_t variance, Covariance& shrinks) noexcept;
  /// The heading is measured, and the pose corrected: the heading by a share of what it is off (2^-16), and
  /// the place by x, y (um per rad).
  void correct_heading(int64_t share, int64_t x, int64_t y) noexcept;

 private:
  enum : uint8_t { kX, kY, kHeading, kPose, kBias = kPose, kRows };

  int32_t in_unit(int64_t variance) const noexcept;
  /// Chooses a unit that has room for all numbers, and for this variance.
  void rescale(int64_t variance) noexcept;
  void scale(int by) noexcept;

  /// With the error of the bias: rad 2^-20 and um, times rad/s 2^-24; the last one is (rad/s)^2 2^-48. With
  /// coarser_, a bias is in 2^coarser_ times that, and so is its change.
  int32_t of_bias_[kRows] = {};
  /// With the error of its change: the same, times 2^-6 per s.
  int32_t of_change_[kRows] = {};
  int32_t change_ = 0;  // (rad/s^2)^2 2^-60
  uint8_t coarser_ = 0;
};

}  // namespace whisker::localization
