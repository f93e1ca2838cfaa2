/// What the body has done since it met an obstacle: whether it has come round it.
#pragma once

#include <stdint.h>

#include "firmware/core/trig.hpp"
#include "firmware/params.hpp"

namespace whisker::nav {

class Circuit {
 public:
  /// The obstacle is met here; the edge is followed from this heading on.
  void begin(Vec at, const Params& params) noexcept;
  void head(Angle heading) noexcept { heading_ = heading; }
  /// Once a tick.
  void move(const Pose& pose, Length travel, Angle turn) noexcept;

  /// Back where it began, the same way, after a whole turn: nothing in between was a way.
  bool closed(const Pose& pose) const noexcept;
  /// Round and round without ever coming by the beginning: this is not what was met. Ask once a tick.
  bool strays(const Pose& pose) noexcept;

 private:
  Vec at_;
  Length scale_;  // what 100 mm are to the reference body
  Angle heading_;
  bool left_ = false;      // has been away from the beginning
  int64_t travel_um_ = 0;  // since the beginning
  int64_t turned_ = 0;     // 2^-32 turn, counter-clockwise positive
  int32_t laps_ = 0;       // whole turns so far
  Vec lap_at_;             // where the last of them ended
};

}  // namespace whisker::nav
