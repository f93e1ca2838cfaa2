/// The way on at an edge: the first free heading from the wall's side; without one, back along the trail.
#pragma once

#include <stdint.h>

#include "firmware/nav/planner.hpp"
#include "firmware/nav/side.hpp"
#include "firmware/nav/trail.hpp"
#include "firmware/params.hpp"

namespace whisker::nav {

class Feeler {
 public:
  enum class Found : uint8_t {
    nothing,  ///< ask again at the next tick
    unseen,   ///< nothing known is in this way: look along it, and ask again
    free,     ///< this way is free
    none,     ///< no way is: retreat
  };
  enum class Retreat : uint8_t {
    under_way,
    there,  ///< a bit back
    stuck,  ///< that way is not free, either: feel again
    lost,   ///< stuck too often since the body last got on
  };
  struct Heading {
    Angle angle;
    Length length;  ///< of the way that it felt for
  };

  /// Forgets the way here.
  void reset(Vec at, const Params& params) noexcept;
  /// Once a tick.
  void move(Vec at) noexcept;

  /// From this heading on, away from the wall. The body must stand while it feels.
  void begin(Angle first, Side wall) noexcept;
  /// From the wall's side of `ahead`, but not from beyond the wall: where the body came to `pose` from lies
  /// there.
  void begin_at_wall(Angle ahead, const Pose& pose, Side wall) noexcept;
  /// All around, first for ways of the full length, then for short ones, then for narrow ones.
  Found step(const View& view, const Params& params, Heading& found) noexcept;

  /// Once a tick after `none`; `stalled`: the body does not get on.
  Retreat retreat(const View& view, bool stalled, const Params& params, Manoeuvre& manoeuvre) noexcept;

  /// On the wall's side something is nearly clear: a door, or the end of the wall.
  bool opening(const View& view, Side wall, const Params& params) const noexcept;

 private:
  enum class Effort : uint8_t { full, short_ways, narrow_ways };

  Trail trail_;
  Angle first_;
  Vec retreat_to_;
  int32_t candidate_ = 0;
  Side wall_ = Side::left;
  Effort effort_ = Effort::full;
  int8_t retreats_ = 0;
};

}  // namespace whisker::nav
