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

}  // namespace whisker::hal::stm32f405
