#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/clock.hpp"
#include "hal/clock.hpp"

namespace whisker::hal::stm32f405 {

/// Time from TIM2, a 32-bit count of microseconds that the hardware keeps; no interrupt is needed.
class Ticker final : public hal::Clock {
 public:
  void start(const Clocks& clocks) noexcept;

  /// Wraps after 71 minutes.
  uint32_t now_us() const noexcept;
  /// Must be called once in 71 minutes at least.
  uint32_t now_ms() noexcept override;

 private:
  uint32_t last_us_ = 0;
  uint32_t rest_us_ = 0;
  uint32_t ms_ = 0;
};

/// Says when the next control tick is due, on a fixed grid of periods.
class Schedule {
 public:
  void begin(uint32_t now_ms) noexcept { last_ = now_ms; }
  /// True once a period. Late by whole periods: those are left out, and missed() counts them.
  bool due(uint32_t now_ms, uint32_t period_ms) noexcept;
  uint32_t missed() const noexcept { return missed_; }

 private:
  uint32_t last_ = 0;
  uint32_t missed_ = 0;
};

}  // namespace whisker::hal::stm32f405
