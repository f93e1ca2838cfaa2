/// Where the body was a moment ago, for readings that tell of then.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"

namespace whisker::localization {

class PoseHistory {
 public:
  static constexpr int kKept = 16;

  /// Keeps instants at least this far apart, so that together they reach back (kKept - 1) times as far.
  void configure(Duration spacing) noexcept { spacing_ = spacing; }
  void reset() noexcept { count_ = 0; }
  void add(const Pose& pose, Time now) noexcept;

  /// The pose at `then`, between the kept ones in a straight line. False: before the oldest one.
  bool at(Time then, Pose& out) const noexcept;

 private:
  struct Instant {
    Pose pose;
    Time time;
  };
  const Instant& back(int n) const noexcept { return kept_[(newest_ + kKept - n) % kKept]; }

  Instant kept_[kKept];
  Instant now_;  // newer than the kept ones, or the newest of them
  Duration spacing_;
  int8_t count_ = 0;
  int8_t newest_ = 0;
};

}  // namespace whisker::localization
