/// Recent poses of the body, for readings with latency.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"

namespace whisker::localization {

class PoseHistory {
 public:
  static constexpr int kKept = 16;

  /// Keeps instants at least this far apart, so the history covers (kKept - 1) times that.
  void configure(Duration spacing) noexcept { spacing_ = spacing; }
  void reset() noexcept { count_ = 0; }
  void add(const Pose& pose, Time now) noexcept;

  /// The pose at `then`, interpolated linearly. False: `then` is before the oldest instant.
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
