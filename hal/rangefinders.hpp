#pragma once

#include "hal/types.hpp"

namespace whisker::hal {

/// The three rangefinders. The core calls read() once per control tick.
///
/// A reading is a promise: no obstacle in the cone of the beam is nearer than its distance, or than
/// RangefinderParams::clear_range if that is less. `clear` promises it for the maximum range. So clear_range
/// is the distance up to which the sensor detects every kind of obstacle at every angle. A sensor that
/// receives no light or sound cannot distinguish open ground from a black, soft or slanted obstacle. Its
/// driver still reports `clear`, because otherwise the robot could not drive in the open; clear_range of the
/// board limits that promise. But only the answer of a sensor that works is `clear`: one that does not
/// answer, or detects its own failure, is `invalid`.
///
/// A distance of the maximum range or more counts as `clear`: a light wall that is seen from there does not
/// show that a dark post on the way would be.
///
/// Below RangefinderParams::min_range a reading is `too_near`: the object is anywhere up to it. A sensor
/// whose output folds back there cannot tell: mount it so far behind the rim that nothing can be nearer.
class Rangefinders {
 public:
  /// Copies the latest measurement of each sensor. Never blocks, and never waits for a measurement. False: no
  /// sensor could be read; `out` is unchanged, and the core counts it and treats every beam as lost. For a
  /// single failed sensor, return true and report RangeStatus::invalid or stale.
  virtual bool read(RangeReadings& out) noexcept = 0;

 protected:
  ~Rangefinders() = default;
};

}  // namespace whisker::hal
