/// A pose from outside on the bus: six values, one frame each, of one tick.
#pragma once

#include <stdint.h>

#include "firmware/can/messages.hpp"
#include "firmware/localization/pose_fix.hpp"

namespace whisker::can {

/// Parts 0 to 5 as raw values.
struct FixValues {
  uint32_t of[kFixValues] = {};
};

/// A sigma above the largest that the bus carries becomes that one.
FixValues values_of(const localization::UncertainPose& fix) noexcept;

/// Collects the parts of one tick at a time.
class FixParts {
 public:
  /// A part of another tick restarts the collection. False: the value is out of its range.
  bool on_frame(const FixValue& part) noexcept;
  bool complete(uint16_t tick) const noexcept { return seen_ == kAllSeen && tick_ == tick; }
  /// Only when complete.
  localization::UncertainPose fix() const noexcept;

 private:
  static constexpr uint8_t kAllSeen = (1 << kFixValues) - 1;

  FixValues values_;
  uint16_t tick_ = 0;
  uint8_t seen_ = 0;
};

}  // namespace whisker::can
