/// The way on at an edge: the first free heading from the wall's side; without one, back along the trail.
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
    unseen,   ///< nothing known is in this way: look along it, and ask again
    free,     ///< this way is free
    none,     ///< no way is: retreat
  };
  enum class Retreat : uint8_t {
    under_way,
    there,  ///< a bit back: feel or follow again
    stuck,  ///< that way is not free, either: feel again
    lost,   ///< too many retreats since the body last got on
  };
  struct Heading {
    Angle angle;
    Length length;  ///< of the way that it felt for
  };

  /// Forgets the way here.
  void reset(Vec at, const Params& params) noexcept;
  /// Once a tick.
  void move(Vec at) noexcept;

  /// From this heading on, away from the wall. The body must stand at `pose` while it feels.
  void begin(Angle first, const Pose& pose, Side wall) noexcept;
  /// From the wall's side of `ahead`, but not from beyond the wall: where the body came to `pose` from lies
  /// there.
  void begin_at_wall(Angle ahead, const Pose& pose, Side wall) noexcept;
  /// For ways of the full length, then for short ones, then for narrow ones; back along the trail only after
  /// all of them, unless that is where it was to go.
  Found step(const View& view, const Params& params, Heading& found) noexcept;
  /// The guard lets nothing through where the last way was found: go on with the next one.
  void refuse() noexcept { ++candidate_; }

  /// Once a tick after `none`; `stalled`: the body does not get on.
  Retreat retreat(const View& view, bool stalled, const Params& params, Manoeuvre& manoeuvre) noexcept;

  /// On the wall's side something is nearly clear: a door, or the end of the wall.
  bool opening(const View& view, Side wall, const Params& params) const noexcept;

 private:
  enum class Effort : uint8_t { full, short_ways, narrow_ways };

  Breadcrumbs breadcrumbs_;
  Angle first_;
  Angle back_;
  static constexpr int kBack = 3;
  Vec retreat_[kBack];  // the places to go back by, the nearest first
  int32_t candidate_ = 0;
  Side wall_ = Side::left;
  Effort effort_ = Effort::full;
  int8_t retreated_ = 0;
  int8_t retreats_ = 0;
  bool may_return_ = false;
};

}  // namespace whisker::planning
