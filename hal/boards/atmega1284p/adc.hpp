#pragma once

#include "hal/boards/atmega1284p/trouble.hpp"

namespace whisker::hal::atmega1284p {

/// Single conversions, 10 bits of the supply.
class Adc {
 public:
  static constexpr int32_t kSupplyMv = 5000;

  explicit Adc(Troubles& troubles) noexcept : troubles_(troubles) {}
  void start() noexcept;

  /// channel: 0..2. Takes 0.11 ms, and waits for about four times that at most.
  /// False: no conversion came; counted, and `mv` is untouched.
  bool convert(uint8_t channel, int16_t& mv) noexcept;

 private:
  Troubles& troubles_;
};

}  // namespace whisker::hal::atmega1284p
