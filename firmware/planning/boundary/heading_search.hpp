/// Finds the next heading along a boundary: the first free one from the wall's side, or else a retreat along
/// the breadcrumbs.
#pragma once

#include <stdint.h>

#include "firmware/params.hpp"
#include "firmware/planning/boundary/breadcrumbs.hpp"
#include "firmware/planning/boundary/side.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

class HeadingSearch {
 public:
  enum class Found : uint8_t {
    nothing,  ///< ask again at the next tick
    unseen,   ///< this heading is unknown: scan along it, and ask again
    free,     ///< this heading is free
    none,     ///< no heading is free: retreat
  };
  enum class Retreat : uint8_t {
    under_way,
    there,  ///< retreated far enough: follow again
    stuck,  ///< that path is not free either: search again
    lost,   ///< too many retreats since the last progress
  };
  struct Heading {
    Angle angle;
    Length length;  ///< of the path examined
  };

  /// Resets the state of this boundary.
  void reset(Vec at, const Params& params) noexcept;
  /// Once per tick.
  void move(Vec at) noexcept;

  /// From this heading on, away from the wall. The body must stand at `pose` during the search.
  void begin(Angle first, const Pose& pose, Side wall) noexcept;
  /// From the wall's side of `ahead`, but not past the backward direction, from which the body came.
  void begin_at_wall(Angle ahead, const Pose& pose, Side wall) noexcept;
  /// Examines paths of full length, then short ones, then narrow ones. The backward direction comes last,
  /// unless the search began there.
  Found step(const View& view, const Params& params, Heading& found) noexcept;
  /// The guard grants nothing along the last heading, or a scan shows nothing of it: continue with the next
  /// one.
  void refuse() noexcept {
    ++candidate_;
    scans_ = 0;
  }

  /// Once per tick after `none`; `stalled`: the body does not move.
  Retreat retreat(const View& view, bool stalled, const Params& params, Manoeuvre& manoeuvre) noexcept;

  /// A path on the wall's side is nearly clear: a door, or the end of the wall.
  bool opening(const View& view, Side wall, const Params& params) const noexcept;

 private:
  enum class Effort : uint8_t { full, short_ways, narrow_ways };

  Breadcrumbs breadcrumbs_;
  Angle first_;
  Angle back_;
  static constexpr int kBack = 3;
  Vec retreat_[kBack];  // the retreat's way points, the nearest first
  int16_t candidate_ = 0;
  Side wall_ = Side::left;
  Effort effort_ = Effort::full;
  int8_t retreated_ = 0;
  int8_t retreats_ = 0;
  int8_t scans_ = 0;  // of this candidate
  bool may_return_ = false;
};

}  // namespace whisker::planning
