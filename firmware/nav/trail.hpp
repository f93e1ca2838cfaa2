/// The last places of the body: the way back.
#pragma once

#include <stdint.h>

#include "firmware/core/trig.hpp"

namespace whisker::nav {

class Trail {
 public:
  void reset(Vec at) noexcept;
  /// True if the body has moved on by a place's distance (40 mm).
  bool add(Vec at) noexcept;
  /// A place passed 80 to 120 mm ago.
  Vec near() const noexcept { return back(2); }
  /// The direction from `pose` to where it was 120 to 160 mm ago; straight behind if it has hardly moved.
  Angle way_back(const Pose& pose) const noexcept;

 private:
  static constexpr int kPlaces = 4;
  Vec back(int n) const noexcept { return places_[(newest_ + kPlaces - n) % kPlaces]; }
  Vec places_[kPlaces];
  int8_t newest_ = 0;
};

}  // namespace whisker::nav
