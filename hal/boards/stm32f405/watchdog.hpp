#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/clock.hpp"

namespace whisker::hal::stm32f405 {

/// The independent watchdog: resets the chip unless fed in time. Once started nothing stops it.
class Watchdog {
 public:
  /// timeout_ms: 1..4095; its oscillator is good to about +-50 %. Bounded by about 40 ms.
  /// False: it did not take the time-out; it runs, perhaps with its default of 512 ms.
  bool start(uint16_t timeout_ms, const Clocks& clocks, Troubles& troubles) noexcept;
  void feed() noexcept;
};

}  // namespace whisker::hal::stm32f405
