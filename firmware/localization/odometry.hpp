/// Dead reckoning from the encoder counts.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "hal/types.hpp"

namespace whisker::localization {

/// Counts since the last update, per wheel.
struct CountStep {
  int32_t left = 0;
  int32_t right = 0;
};

/// Dead reckoning of a differential drive. The heading is computed from the difference of the total counts,
/// so it accumulates no rounding error; the position is summed in units of 2^-16 um.
class Odometry {
 public:
  /// Rounds the rim travel per count to 2^-17 um and the turn per count to a relative 1e-8.
  void configure(const Params& params) noexcept;
  /// Sets the pose; the next counts are the new zero.
  void place(const Pose& pose) noexcept;
  /// Takes in both counters, modulo 2^24, `since` the last update. False: a wheel moved further than at twice
  /// its full speed over that time plus one period; the pose then ignores the step, and the new counts are
  /// the new zero.
  bool update(const hal::EncoderCounts& counts, Duration since, CountStep& step) noexcept;
  /// The same in two steps: take() and, unless it is false, advance(), by the wheels alone or with the turn
  /// of the body over this step.
  bool take(const hal::EncoderCounts& counts, Duration since, CountStep& step) noexcept;
  void advance(const CountStep& step) noexcept;
  void advance(const CountStep& step, Angle turn) noexcept;
  /// The difference of counts, right minus left, that turns the body at this step: 2^-12 counts.
  int64_t difference(const CountStep& step) const noexcept;
  /// The turn for such a difference.
  Angle turn_of(int64_t difference) const noexcept;
  /// Counts of one wheel for a full turn of the body with the other wheel at rest.
  int32_t counts_per_turn() const noexcept;

  Pose pose() const noexcept { return {at_, heading_}; }
  /// The length of the way so far, um modulo 2^32; place() does not change it.
  uint32_t travelled_um() const noexcept { return travelled_um_; }

 private:
  struct Skew {
    int64_t sum = 0;             // of both, counts since place()
    int64_t um_per_count = 0;    // of the difference, 2^-16 um
    int64_t turn_per_count = 0;  // of the sum, 2^-48 turn
    int32_t share = 0;           // of the sum in the difference that turns, 2^-24
  };
  int64_t x_ = 0;  // 2^-16 um
  int64_t y_ = 0;
  Vec at_;  // the same, rounded
  uint32_t travelled_um_ = 0;
  Angle start_heading_;
  Angle heading_;
  int64_t difference_ = 0;       // right minus left, counts since place()
  int64_t um_per_count_ = 0;     // 2^-16 um
  uint64_t turn_per_count_ = 0;  // 2^-48 turn
  Skew skew_;
  Duration period_;
  uint32_t counts_per_ms_ = 0;  // at twice the full speed, 2^-8 count
  hal::EncoderCounts last_{};
  bool has_last_ = false;
};

}  // namespace whisker::localization
