/// When the controller last heard each part of the base.
#pragma once

#include <stdint.h>

#include "firmware/can/limits.hpp"
#include "firmware/can/messages.hpp"
#include "hal/types.hpp"

namespace whisker::can {

class Heard {
 public:
  void beam(int beam, uint32_t now_ms) noexcept { beams_[beam] = now_ms; }
  /// Counts that the drive refused are not heard.
  void wheels(const WheelState& state, uint32_t now_ms) noexcept;
  /// A complete input set was taken.
  void set(uint32_t now_ms) noexcept { set_ = now_ms; }
  /// An order begins: everything counts as just heard.
  void begin(uint32_t now_ms) noexcept;

  /// A beam is silent for so long that the wheels must stand until it is back.
  bool holds(uint32_t now_ms) const noexcept { return silent(kHoldAfter_ms, now_ms); }
  /// It is silent for so long that the mission ends.
  bool lost_beam(uint32_t now_ms) const noexcept { return silent(kRangeLatch_ms, now_ms); }
  /// The same of the counts, or of complete sets.
  bool lost_counts(uint32_t now_ms) const noexcept {
    return now_ms - wheels_ > kOdometryLate_ms || now_ms - set_ > kRangeLatch_ms;
  }
  /// The counts have not changed for a while.
  bool stands(uint32_t now_ms) const noexcept;

 private:
  bool silent(uint32_t longest_ms, uint32_t now_ms) const noexcept;

  uint32_t beams_[hal::kBeams] = {};
  uint32_t wheels_ = 0;
  uint32_t set_ = 0;
  hal::EncoderCounts counts_{};
  uint32_t turned_at_ = 0;
  bool counted_ = false;  // counts_ are those of the base
  bool turned_ = false;   // at turned_at_
};

}  // namespace whisker::can
