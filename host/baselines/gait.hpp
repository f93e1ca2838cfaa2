/// How every boundary follower here drives: speeds that the shield guards, and looks.
#pragma once

#include <cstdint>

#include "firmware/nav/planner.hpp"
#include "firmware/params.hpp"

namespace whisker::baselines {

constexpr Length kProbe = 150_mm;  ///< proved free ahead before a heading is taken

enum class Way : std::uint8_t { free, open, blocked };  ///< open: something in it was never seen

/// What the patch says of a straight way that keeps `margin` free around the body.
Way way(const nav::View& view, Angle heading, Length length, Length margin, const Params& params);

nav::Manoeuvre stop();
nav::Manoeuvre cruise(Speed forward, AngularRate turn, const Params& params);
/// Towards this heading, the slower the more it has to turn.
nav::Manoeuvre steer(const nav::View& view, Angle heading, Speed top, const Params& params);
/// On the spot towards this heading.
nav::Manoeuvre face(const nav::View& view, Angle heading, const Params& params);
bool faces(const nav::View& view, Angle heading);
/// Along the wall on this side (+1: left), 0.15 m from it or in the middle of a narrower passage.
nav::Manoeuvre along_wall(const nav::View& view, std::int32_t side, const Params& params);

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
