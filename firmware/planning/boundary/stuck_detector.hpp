/// Detects that the guard holds the body.
#pragma once

#include <stdint.h>

#include "firmware/params.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

class StuckDetector {
 public:
  void reset() noexcept { slow_for_ = Duration{}; }
  /// Once per tick while the body shall drive. True after `patience` below a 15th of the full speed; time in
  /// which the guard holds a body that does not turn counts four times.
  bool stalled(const View& view, Duration patience, const Params& params) noexcept;

 private:
  Duration slow_for_;
};

/// A patience that allows for starting up and for readings of the ground ahead: 0.8 s for the reference
/// robot, or 0.2 s held by the guard.
Duration patience(const Params& params) noexcept;

}  // namespace whisker::planning
