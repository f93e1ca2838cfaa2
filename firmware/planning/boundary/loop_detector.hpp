/// Detects whether the body closed the loop around the obstacle that it follows.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "firmware/planning/boundary/side.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

class LoopDetector {
 public:
  /// Evidence for laps. In pockets the body may turn fully while it stands, so turning alone does not count
  /// laps.
  enum class Evidence : uint8_t {
    turning,  ///< whole turns
    place,    ///< the same place and heading, after a far distance or some travel
  };

  /// Marks the hit point.
  void begin(const View& view, const Params& params) noexcept;
  /// Once per tick.
  void move(const View& view) noexcept;

  /// True if the body is back at the hit point, with the heading of the first call, after a full turn since
  /// then or a far distance: then it passed no exit. Where the boundary leads round one thing to the left and
  /// round another to the right, the turns cancel; there, the third return counts. The place widens with the
  /// bound of the pose; a loop that is not twice as large as what the bound has grown meanwhile cannot be
  /// told from none. Call while following the boundary.
  bool closed(const View& view, Evidence evidence = Evidence::turning) noexcept;
  /// Whether the followed boundary, with the wall on this side, can separate `from` from `to`: the loop
  /// encloses `to`, or, if the wall is outside, `from`. Inside means not farther from the hit point than the
  /// loop reached.
  bool may_part(Vec from, Vec to, Side wall) const noexcept;
  /// False where fewer than half of the readings showed anything near: what was followed is unknown ground.
  bool is_seen() const noexcept { return seen_ >= 0; }
  /// True after two laps that end in one place without passing the hit point, or, by turning alone, after
  /// four: this is another obstacle. Call once per tick.
  bool strays(const View& view, Evidence evidence = Evidence::turning) noexcept;

 private:
  /// Counts how often the body came back to the hit point.
  bool returned(Length off) noexcept;
  /// Since the end of the last lap.
  Length travelled(const View& view) const noexcept;
  /// A lap that began where the last one ended ends there, with about the same heading.
  bool rounds(const View& view) const noexcept;

  Vec at_;
  Length scale_;  // 100 mm, scaled from the reference body
  Angle heading_;
  bool follows_ = false;  // heading_ is set
  bool left_ = false;     // has been away from the hit point
  bool away_ = false;     // the same since the last return
  int8_t returns_ = 0;
  Length farthest_;        // from the hit point
  uint32_t began_um_ = 0;  // View::travelled_um at the hit point
  Length bound_;           // View::bound there
  Angle last_;             // the heading of the previous tick
  int64_t turned_ = 0;     // while it follows, 2^-32 turn, counter-clockwise positive
  int16_t laps_ = 0;       // whole turns so far
  int16_t seen_ = 0;       // readings that showed something near, less those that did not
  Vec lap_at_;             // position at the end of the last one
  uint32_t lap_um_ = 0;    // View::travelled_um there
};

}  // namespace whisker::planning
