/// Every wait on a register is bounded by a count of polls, so no timer has to run for it to end.
#pragma once

#include <stdint.h>

#include "hal/boards/common/io.hpp"

namespace whisker::hal::mcu {

/// A number of polls of a register, shared by all waits of one operation.
class Patience {
 public:
  /// A poll takes at least this many core cycles: a load over the bus, a test and a branch. So a wait lasts
  /// at least as long as requested, and at most about four times as long.
  static constexpr uint32_t kCyclesPerPoll = 8;

  explicit constexpr Patience(uint32_t polls) noexcept : left_(polls) {}
  static constexpr Patience for_us(uint32_t us, uint32_t core_hz) noexcept {
    return Patience(us * (core_hz / 1000000) / kCyclesPerPoll + 1);
  }

  /// False: no polls left.
  bool spend() noexcept {
    if (left_ == 0) return false;
    --left_;
    return true;
  }
  /// Polls until the field is not zero, or is zero. False: it did not happen in time.
  bool until(Address base, Field field, bool wanted) noexcept {
    while (is_set(base, field) != wanted) {
      if (!spend()) return false;
    }
    return true;
  }

 private:
  uint32_t left_;
};

}  // namespace whisker::hal::mcu
