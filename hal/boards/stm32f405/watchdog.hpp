#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/clock.hpp"

namespace whisker::hal::stm32f405 {

/// The independent watchdog: resets the chip unless fed in time. Once started it cannot be stopped.
class Watchdog {
 public:
  /// timeout_ms: 1..4095; its oscillator has an error of about +-50 %. Waits at most about 40 ms. False: it
  /// did not accept the time-out; it runs, possibly with its default of 512 ms.
  bool start(uint16_t timeout_ms, const Clocks& clocks, Troubles& troubles) noexcept;
  void feed() noexcept;
};

}  // namespace whisker::hal::stm32f405
