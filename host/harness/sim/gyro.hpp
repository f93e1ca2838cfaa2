/// The yaw-rate gyro: bias, scale, noise, resolution, range and latency of a real one.
#pragma once

#include <stdint.h>

#include "hal/types.hpp"
#include "host/harness/sim/random.hpp"
#include "host/harness/sim/spec.hpp"

namespace whisker::sim {

/// Time over which the bias changes by the drawn warm-up, linearly; it stays there. s
constexpr double kWarmUp = 600;

/// Sample k is the mean rate from (k - 1) / rate to k / rate, times 1 + scale error, plus bias and white
/// noise, rounded to range / 32768 and limited to +-32767.
class Gyro {
 public:
  Gyro(const RobotSpec& robot, const NoiseSpec& noise, uint64_t seed);

  /// The body turned by this angle, rad, at a constant rate from from_us to to_us. Call for all times, in
  /// order.
  void turn(double angle, int64_t from_us, int64_t to_us);
  /// The samples that have arrived at now_us, not before the last turn().
  hal::GyroReading read(int64_t now_us) const;

 private:
  void sample(double end_s);

  static constexpr int kInTransit = 32;

  double per_radian_;  // units of a sample, per rad/s
  double interval_s_;
  double latency_s_;
  double scale_;
  double bias_;       // rad/s
  double warm_up_;    // rad/s
  double noise_;      // rad/s, of a sample
  double angle_ = 0;  // turned since the last sample
  int64_t taken_ = 0;
  hal::GyroReading at_[kInTransit] = {};  // after sample k, at k modulo kInTransit
  Random walk_;
};

}  // namespace whisker::sim
