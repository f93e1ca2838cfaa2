#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/clock.hpp"

namespace whisker::hal::stm32f405 {

/// A number from the noise of the chip, after power_peripherals(). It needs the 48 MHz of the PLL. Waits at
/// most 1 ms. False: there is none, which is counted; `number` is unchanged.
bool draw_random(const Clocks& clocks, Troubles& troubles, uint32_t& number) noexcept;

}  // namespace whisker::hal::stm32f405
