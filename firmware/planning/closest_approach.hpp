/// The least distance to the goal so far.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"

namespace whisker::planning {

class ClosestApproach {
 public:
  /// Initially farther than any place.
  void reset() noexcept { distance_ = Length::from_raw(INT32_MAX); }
  void set(Vec at, Length distance) noexcept {
    at_ = at;
    distance_ = distance;
  }
  /// Adapts the place to a moved goal.
  void follow(Vec goal) noexcept {
    if (distance_ != Length::from_raw(INT32_MAX)) distance_ = norm(goal - at_);
  }
  Length distance() const noexcept { return distance_; }

 private:
  Vec at_;
  Length distance_ = Length::from_raw(INT32_MAX);
};

}  // namespace whisker::planning
