#pragma once

#include "hal/types.hpp"

namespace whisker::hal {

/// The three rangefinders. The core calls read() once a control tick.
///
/// What a reading claims: nothing that the robot must avoid lies in the beam's cone nearer than its distance,
/// or than RangefinderParams::clear_range if that is less. `clear` claims it for the maximum range. So
/// clear_range is the distance to which the sensor sees every kind of thing that there is, at every slant: a
/// sensor that gets no light or sound back cannot tell open ground from what is black, soft or slanted. Such
/// a driver says `clear` all the same, or the robot would be blind in the open; what that is worth its board
/// states. A sensor that knows that it failed says `invalid`.
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
