/// A turn to both sides of the goal's direction, before the first movement.
#pragma once

#include <stdint.h>

#include "firmware/params.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

class Survey {
 public:
  void reset() noexcept { sides_ = 0; }
  /// Once per tick. True: faced both sides.
  bool step(const View& view, Angle target, const Params& params, Manoeuvre& manoeuvre) noexcept;

 private:
  int8_t sides_ = 0;
};

}  // namespace whisker::planning
