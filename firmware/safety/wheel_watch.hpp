/// Checks that each wheel follows its command.
#pragma once

#include <stdint.h>

#include "firmware/localization/odometry.hpp"
#include "firmware/math/units.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "firmware/params.hpp"

namespace whisker::safety {

/// Compares the counts of each encoder with the commands of its wheel, delayed by the motor lag, over a
/// stretch of travel: 40 mm for the reference body, ten counts, or the travel at full speed in twice the
/// longest gap between ticks or twice the lag, whichever is longest; a runaway, over the travel in twice both
/// together if that is longer. A wheel that follows within a factor of three never causes a fault, nor one
/// that follows sooner than stated; wheel slip is far below that. A wheel that swings within its counts may
/// count nothing.
class WheelWatch {
 public:
  enum class Finding : uint8_t {
    none,
    stalled,  ///< less than a quarter of the commanded distance was counted, while the other wheel turned,
              ///< and a quarter of the stretch is missing in one direction; or 15 stretches are missing,
              ///< while the other wheel turned at all
    runaway,  ///< more than three times the commanded distance was counted, or counts went backwards
  };

  void configure(const Params& params) noexcept;
  void reset() noexcept { wheel_[0] = wheel_[1] = {}; }
  /// Call once per tick: the wheels have turned at these speeds since the last tick.
  void expect(WheelPair speeds, Duration elapsed) noexcept;
  /// Call once per step of the counts.
  Finding judge(const localization::CountStep& counts) noexcept;

 private:
  struct Wheel {
    Length expected;  // in either direction
    Length counted;
    Length commanded_way;  // signed
    Length counted_way;
    Length other;       // counted by the other wheel
    int16_t slack = 0;  // counts within which it may oscillate
    uint16_t held = 0;  // commanded in one direction beyond a stretch, and not counted; 2^6 um
  };
  /// The counts of this step without the oscillation of a wheel that stands between two counts.
  static int32_t steady(Wheel& wheel, int32_t counts) noexcept;
  Finding judge(Wheel& wheel) const noexcept;
  Length way(int32_t counts) const noexcept { return Length::from_raw(saturate32(counts * um_per_count_)); }

  Wheel wheel_[2];
  Length stretch_;
  Length ahead_;  // the least way of a runaway
  int64_t um_per_count_ = 0;
};

}  // namespace whisker::safety
