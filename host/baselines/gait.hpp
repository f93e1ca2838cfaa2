/// What every boundary follower here needs besides the core's steering.
#pragma once

#include <cstdint>

#include "firmware/nav/planner.hpp"
#include "firmware/params.hpp"

namespace whisker::baselines {

nav::Manoeuvre stop();
/// Turns on the spot towards this heading. True within 3 degrees of it.
bool face(const nav::View& view, Angle heading, const Params& params, nav::Manoeuvre& manoeuvre);

/// Notes when the shield lets nothing through.
class Stall {
 public:
  void reset() { slow_ticks_ = 0; }
  /// Once a tick while it wants to drive.
  bool stalled(const nav::View& view, const Params& params);

 private:
  std::int32_t slow_ticks_ = 0;
};

/// Turns beams onto what was never seen in a way, until the way is free or blocked.
class Look {
 public:
  void begin() { halting_ = true; }  ///< the caller stops the body
  /// Along this way from where the body is. True when it is over; otherwise what to do next.
  bool step(const nav::View& view, Angle heading, Length length, const Params& params,
            nav::Manoeuvre& manoeuvre);

 private:
  bool halting_ = false;
};

}  // namespace whisker::baselines
