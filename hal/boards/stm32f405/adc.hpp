#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/clock.hpp"

namespace whisker::hal::stm32f405 {

/// Single conversions of ADC1, 12 bits, sampled long enough for a source of 10 kOhm.
class Adc {
 public:
  static constexpr int32_t kSupplyMv = 3300;

  void start(const Clocks& clocks, Troubles& troubles) noexcept;

  /// channel: 10..12, the pins of `wiring`. Takes 5 us, and waits for 50 us at most.
  /// False: no conversion came; counted, `mv` is untouched, and the converter is switched off and on.
  bool convert(uint8_t channel, int16_t& mv) noexcept;

 private:
  uint32_t core_hz_ = 0;
  Troubles* troubles_ = nullptr;
};

}  // namespace whisker::hal::stm32f405
