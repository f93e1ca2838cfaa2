#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/clock.hpp"

namespace whisker::hal::stm32f405 {

/// Single conversions of ADC1, 12 bits, with a sampling time for a source of 10 kOhm.
class Adc {
 public:
  static constexpr int32_t kSupplyMv = 3300;

  void start(const Clocks& clocks, Troubles& troubles) noexcept;

  /// channel: 10..12, the pins of `wiring`. Takes 5 us, and waits for at most 50 us. False: no conversion
  /// arrived; it was counted, `mv` is unchanged, and the ADC was restarted.
  bool convert(uint8_t channel, int16_t& mv) noexcept;

 private:
  uint32_t core_hz_ = 0;
  Troubles* troubles_ = nullptr;
};

}  // namespace whisker::hal::stm32f405
