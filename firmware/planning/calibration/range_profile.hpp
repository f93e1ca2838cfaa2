/// The readings of the beams over the heading, while the body turns on the spot.
#pragma once

#include <stdint.h>

#include "hal/types.hpp"

namespace whisker::planning {

/// Samples of each beam with rising heading.
class RangeProfile {
 public:
  /// Units of a heading in a turn.
  static constexpr int32_t kTurn = 48000;
  /// Samples of a beam.
  static constexpr int kMost = 320;
  /// Samples are at least this far apart, so that 1.25 turns fit.
  static constexpr int32_t kSpacing = 190;

  struct Sample {
    uint16_t at;
    uint16_t mm;
  };

  void clear() noexcept { count_[0] = count_[1] = count_[2] = echoes_ = 0; }
  /// Leaves out what is too near the last sample of this beam, or does not fit. 0 <= at < 65536.
  void add(int beam, int32_t at, uint16_t mm, bool echo) noexcept;

  int count(int beam) const noexcept { return count_[beam]; }
  const Sample& at(int beam, int index) const noexcept { return samples_[beam][index]; }
  /// Samples that are a distance, of all beams.
  int echoes() const noexcept { return echoes_; }

 private:
  Sample samples_[hal::kBeams][kMost] = {};
  int16_t count_[hal::kBeams] = {};
  int16_t echoes_ = 0;
};

}  // namespace whisker::planning
