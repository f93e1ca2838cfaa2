/// The wheel encoders: the distance rolled, with their own errors.
#pragma once

#include <stdint.h>

#include "hal/types.hpp"
#include "host/harness/sim/random.hpp"
#include "host/harness/sim/spec.hpp"

namespace whisker::sim {

/// counts = floor((distance + drift) * counts_per_m * (1 + scale error)) modulo 2^24 for each wheel. The
/// scale error of a wheel is its own plus one common to both; they are drawn once. The drift is a random
/// walk, opposite on the two wheels: the odometry heading gains an error of standard deviation drift *
/// sqrt(path), while the body itself does not move.
class Encoders {
 public:
  Encoders(const RobotSpec& robot, const NoiseSpec& noise, uint64_t seed);

  /// The wheels rolled this far, m, while the centre of the body travelled `path`, m (not negative).
  void roll(double left, double right, double path);
  hal::EncoderCounts counts() const;

 private:
  double counts_per_m_[2];
  double drift_per_sqrt_m_;  // of one wheel, m
  double distance_[2] = {0, 0};
  double drift_ = 0;
  Random walk_;
};

}  // namespace whisker::sim
