/// Whether the guard lets nothing through.
#pragma once

#include <stdint.h>

#include "firmware/params.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

class StuckDetector {
 public:
  void reset() noexcept { slow_for_ = Duration{}; }
  /// Once a tick while the body is to drive. True after `patience` below a 15th of the full speed; time for
  /// which the guard holds back a body that does not turn counts four times.
  bool stalled(const View& view, Duration patience, const Params& params) noexcept;

 private:
  Duration slow_for_;
};

/// The patience that leaves time to start moving, and for readings to show what is ahead: for the reference
/// robot 0.8 s, which is 0.2 s of being held back.
Duration patience(const Params& params) noexcept;

}  // namespace whisker::planning
