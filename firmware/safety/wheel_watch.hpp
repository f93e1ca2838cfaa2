/// Whether each wheel turns as it is told.
#pragma once

#include <stdint.h>

#include "firmware/localization/odometry.hpp"
#include "firmware/math/units.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "firmware/params.hpp"

namespace whisker::safety {

/// Compares what each encoder counts with what its wheel was commanded, behind the motor's lag, over a
/// stretch of travel: 40 mm for the reference body, ten counts, or two of the longest gaps between ticks at
/// full speed, whichever is most. A wheel that follows within a factor of three is never accused; slip and a
/// lag that is not quite the stated one are far from that.
class WheelWatch {
 public:
  enum class Finding : uint8_t {
    none,
    stalled,  ///< less than a quarter of the commanded way was counted, while the other wheel did turn
    runaway,  ///< more than three times the commanded way was counted, or it was counted backwards
  };

  void configure(const Params& params) noexcept;
  void reset() noexcept { wheel_[0] = wheel_[1] = {}; }
  /// Once a tick: the wheels have turned at these speeds since the tick before.
  void expect(WheelPair speeds, Duration elapsed) noexcept;
  /// Once for each step of the counts.
  Finding judge(const localization::CountStep& counts) noexcept;

 private:
  struct Wheel {
    Length expected;  // whichever way it turned
    Length counted;
    Length commanded_way;  // signed
    Length counted_way;
    Length other;       // counted by the other wheel
    int32_t slack = 0;  // counts within which it may tremble
  };
  /// The counts of this step without the trembling of one that stands between two of them.
  static int32_t steady(Wheel& wheel, int32_t counts) noexcept;
  Finding judge(Wheel& wheel) const noexcept;
  Length way(int32_t counts) const noexcept { return Length::from_raw(saturate32(counts * um_per_count_)); }

  Wheel wheel_[2];
  Length stretch_;
  int64_t um_per_count_ = 0;
};

}  // namespace whisker::safety
