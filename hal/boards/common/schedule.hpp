#pragma once

#include <stdint.h>

namespace whisker::hal::mcu {

/// Signals when the next control tick is due, on a fixed grid of periods.
class Schedule {
 public:
  void begin(uint32_t now_ms) noexcept { last_ = now_ms; }
  /// True once per period. After a delay of whole periods, those are skipped; missed() counts them.
  bool due(uint32_t now_ms, uint32_t period_ms) noexcept {
    const uint32_t periods = (now_ms - last_) / period_ms;
    if (periods == 0) return false;
    missed_ += periods - 1;
    last_ += periods * period_ms;
    return true;
  }
  uint32_t missed() const noexcept { return missed_; }

 private:
  uint32_t last_ = 0;
  uint32_t missed_ = 0;
};

}  // namespace whisker::hal::mcu
