#pragma once

#include <stdint.h>

namespace whisker::hal::pico {

constexpr uint32_t kCoreHz = 125000000;

/// From the crystal: 125 MHz for the core and all peripherals, and the microsecond of timer and watchdog.
/// Waits 20 ms at most. False: the crystal or the PLL did not start; without them, no time is right.
bool start_clocks() noexcept;
/// After start_clocks(): 48 MHz for the USB. Waits 20 ms at most. False: its PLL did not start.
bool start_usb_clock() noexcept;

}  // namespace whisker::hal::pico
