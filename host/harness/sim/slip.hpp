/// Wheels that slip while they speed up.
#pragma once

#include <stdint.h>

#include "host/harness/sim/random.hpp"
#include "host/harness/sim/spec.hpp"
#include "host/harness/sim/wheel.hpp"

namespace whisker::sim {

/// While the size of a wheel's speed grows by more than a twentieth of the acceleration limit, a share of its
/// travel is lost: the encoder counts it, but the body does not move. Each time that a wheel begins to speed
/// up, it draws a new share, evenly from 0 to twice NoiseSpec::wheel_slip.
class WheelSlip {
 public:
  /// wheel: 0 left, 1 right.
  WheelSlip(const RobotSpec& robot, const NoiseSpec& noise, uint64_t seed, uint32_t wheel);

  /// Travel over the ground, m, of a wheel that had this speed before the step.
  double ground(double speed_before, const WheelStep& step, double step_s);

 private:
  double mean_;
  double least_growth_;  // m/s^2
  double share_ = 0;
  bool speeds_up_ = false;
  Random shares_;
};

}  // namespace whisker::sim
