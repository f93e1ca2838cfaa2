/// Whether the body has come round the obstacle that it follows.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "firmware/planning/boundary/side.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

class LoopDetector {
 public:
  /// What tells laps from other movements. In pockets the body may turn all round while it stands, so its
  /// turning is no count of laps.
  enum class Evidence : uint8_t {
    turning,  ///< whole turns
    place,    ///< the same place and heading, and far away, or some way, in between
  };

  /// The obstacle is met here.
  void begin(const View& view, const Params& params) noexcept;
  /// Once a tick.
  void move(const View& view) noexcept;

  /// Back where it began, with the heading that closed() was first asked at, after a whole turn or from far
  /// away: nothing in between was a way. Ask while the edge is followed.
  bool closed(const View& view, Evidence evidence = Evidence::turning) noexcept;
  /// Whether the followed boundary, with the wall on this side, can separate `from` from `to`: `to` lies
  /// within the loop, or, if the wall is all around, `from` does. Within is what is no farther from the
  /// beginning than the loop reached.
  bool may_part(Vec from, Vec to, Side wall) const noexcept;
  /// Whole turns that never pass the beginning: this is another obstacle. True after two laps that end in one
  /// place, or, by turning alone, after four. Ask once a tick.
  bool strays(const View& view, Evidence evidence = Evidence::turning) noexcept;

 private:
  Vec at_;
  Length scale_;  // what 100 mm are to the reference body
  Angle heading_;
  bool follows_ = false;   // from heading_ on
  bool left_ = false;      // has been away from the beginning
  Length farthest_;        // from the beginning
  uint32_t began_um_ = 0;  // View::travelled_um at the beginning
  Angle last_;             // the heading of the tick before
  int64_t turned_ = 0;     // 2^-32 turn, counter-clockwise positive
  int32_t laps_ = 0;       // whole turns so far
  Vec lap_at_;             // where the last of them ended
  uint32_t lap_um_ = 0;    // View::travelled_um there
};

}  // namespace whisker::planning
