/// Whether the shield lets nothing through.
#pragma once

#include <stdint.h>

#include "firmware/nav/planner.hpp"
#include "firmware/params.hpp"

namespace whisker::nav {

class Stall {
 public:
  void reset() noexcept { slow_ticks_ = 0; }
  /// Once a tick while the body is to drive. True after `patience` ticks below a 15th of the full speed; one
  /// at which the shield holds back a body that does not turn counts four times.
  bool stalled(const View& view, int32_t patience, const Params& params) noexcept;

 private:
  int32_t slow_ticks_ = 0;
};

/// The patience that leaves time to start moving, and for readings to show what is ahead: for the reference
/// robot 0.2 s, and 0.8 s while it turns.
int32_t patience(const Params& params) noexcept;

}  // namespace whisker::nav
