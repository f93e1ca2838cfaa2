#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/clock.hpp"
#include "hal/clock.hpp"

namespace whisker::hal::stm32f405 {

/// Time from TIM2, a 32-bit hardware counter of microseconds; it needs no interrupt.
class Ticker final : public hal::Clock {
 public:
  void start(const Clocks& clocks) noexcept;

  /// Wraps after 71 minutes.
  uint32_t now_us() const noexcept;
  /// Must be called at least once in 71 minutes.
  uint32_t now_ms() noexcept override;

 private:
  uint32_t last_us_ = 0;
  uint32_t rest_us_ = 0;
  uint32_t ms_ = 0;
};

/// Signals when the next control tick is due, on a fixed grid of periods.
class Schedule {
 public:
  void begin(uint32_t now_ms) noexcept { last_ = now_ms; }
  /// True once per period. After a delay of whole periods, those are skipped; missed() counts them.
  bool due(uint32_t now_ms, uint32_t period_ms) noexcept;
  uint32_t missed() const noexcept { return missed_; }

 private:
  uint32_t last_ = 0;
  uint32_t missed_ = 0;
};

}  // namespace whisker::hal::stm32f405
