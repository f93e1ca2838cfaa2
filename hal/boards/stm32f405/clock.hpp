#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/trouble.hpp"

namespace whisker::hal::stm32f405 {

/// The frequencies from which the drivers derive theirs.
struct Clocks {
  uint32_t core_hz;
  uint32_t apb1_hz;    ///< I2C, USART2, CAN
  uint32_t apb2_hz;    ///< ADC
  uint32_t timer1_hz;  ///< the timers on APB2
  uint32_t timer2_hz;  ///< the timers on APB1
};

/// After reset.
constexpr Clocks kInternalClocks = {16000000, 16000000, 16000000, 16000000, 16000000};
/// After set-up.
constexpr Clocks kFullClocks = {168000000, 42000000, 84000000, 168000000, 84000000};

constexpr uint32_t kCrystalHz = 8000000;

/// From reset to 168 MHz with an 8 MHz crystal; without one, with the internal oscillator; without a PLL
/// lock, stays at 16 MHz. Returns the result and counts each fallback. Waits at most about 10 ms.
Clocks start_clocks(Troubles& troubles) noexcept;

}  // namespace whisker::hal::stm32f405
