/// What the body has done since it met an obstacle: whether it has come round it.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "firmware/planning/boundary/side.hpp"

namespace whisker::planning {

class LoopDetector {
 public:
  /// The obstacle is met here; the edge is followed from this heading on.
  void begin(Vec at, const Params& params) noexcept;
  void head(Angle heading) noexcept { heading_ = heading; }
  /// Once a tick.
  void move(const Pose& pose, Length travel, Angle turn) noexcept;

  /// Back where it began, the same way, after a whole turn: nothing in between was a way.
  bool closed(const Pose& pose) const noexcept;
  /// Whether what was gone round, with the wall on this side, can be between `from` and `to`: it has `to` in
  /// its middle, or, seen from within, `from`. Places are told apart by how far the circuit reached.
  bool may_part(Vec from, Vec to, Side wall) const noexcept;
  /// Round and round without ever coming by the beginning: this is not what was met. Two laps that end in one
  /// place, or four. Ask once a tick.
  bool strays(const Pose& pose) noexcept;

 private:
  Vec at_;
  Length scale_;  // what 100 mm are to the reference body
  Angle heading_;
  bool left_ = false;      // has been away from the beginning
  Length farthest_;        // from the beginning
  int64_t travel_um_ = 0;  // since the beginning
  int64_t turned_ = 0;     // 2^-32 turn, counter-clockwise positive
  int32_t laps_ = 0;       // whole turns so far
  Vec lap_at_;             // where the last of them ended
};

}  // namespace whisker::planning
