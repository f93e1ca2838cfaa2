/// The last positions of the body, for the retreat.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"

namespace whisker::planning {

class Breadcrumbs {
 public:
  /// Minimum distance between breadcrumbs.
  void reset(Vec at, Length apart) noexcept;
  /// True if the body moved by at least that distance.
  bool add(Vec at) noexcept;
  static constexpr int kPlaces = 4;
  /// Breadcrumb n, 0 = newest; n < kPlaces.
  Vec back(int n) const noexcept { return places_[(newest_ + kPlaces - n) % kPlaces]; }
  /// The direction from `pose` to the breadcrumb three to four before; straight behind if the body has hardly
  /// moved.
  Angle way_back(const Pose& pose) const noexcept;

 private:
  Vec places_[kPlaces];
  Length apart_;
  int8_t newest_ = 0;
};

}  // namespace whisker::planning
