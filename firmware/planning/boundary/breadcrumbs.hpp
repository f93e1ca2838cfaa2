/// The last places that the body passed: the way back.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"

namespace whisker::planning {

class Breadcrumbs {
 public:
  /// Keeps places this far apart.
  void reset(Vec at, Length apart) noexcept;
  /// True if the body has moved on by that.
  bool add(Vec at) noexcept;
  static constexpr int kPlaces = 4;
  /// The last place kept, n = 0, or one of those before it; n < kPlaces.
  Vec back(int n) const noexcept { return places_[(newest_ + kPlaces - n) % kPlaces]; }
  /// The direction from `pose` to where it was three to four of them ago; straight behind if it has hardly
  /// moved.
  Angle way_back(const Pose& pose) const noexcept;

 private:
  Vec places_[kPlaces];
  Length apart_;
  int8_t newest_ = 0;
};

}  // namespace whisker::planning
