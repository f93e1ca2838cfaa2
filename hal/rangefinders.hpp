#pragma once

#include "hal/wire.hpp"

namespace whisker::hal {

/// The three rangefinders. The core calls read() once a control tick.
class Rangefinders {
 public:
  /// Copies the latest measurement of each sensor. Never blocks, and never waits for a measurement.
  /// False: the sensors could not be asked at all; `out` is untouched, and the core counts it
  /// and treats every beam as lost. One dead sensor is no reason for false: give it
  /// RangeStatus::invalid or stale.
  virtual bool read(RangeReadings& out) noexcept = 0;

 protected:
  ~Rangefinders() = default;
};

}  // namespace whisker::hal
