#pragma once

#include "hal/types.hpp"

namespace whisker::hal {

/// A yaw-rate gyro; optional. The core calls read() once per control tick.
///
/// The driver adds up every sample of the chip, so a call that is late or missed loses nothing. It corrects
/// neither bias nor scale: the core learns the bias while the robot stands, and GyroParams has the scale.
class Gyro {
 public:
  /// Copies the sum of all samples so far. Never blocks, and never waits for a sample. False: the chip does
  /// not answer; `out` is unchanged. The core then turns by the wheels, and takes back what the sums lack at
  /// the next reading if that comes soon enough (localization/gyro_heading.hpp).
  virtual bool read(GyroReading& out) noexcept = 0;

 protected:
  ~Gyro() = default;
};

}  // namespace whisker::hal
