#pragma once

#include <stdint.h>

#include "hal/types.hpp"

namespace whisker::hal::stm32f405 {

/// Both quadrature encoders: TIM3 and TIM4 count the edges of their two inputs in 16 bits.
class Encoders {
 public:
  void start() noexcept;
  /// Counts since start(). Call it at least once per 32767 counts of a wheel. Always returns true.
  bool read(hal::EncoderCounts& out) noexcept;

 private:
  hal::EncoderCounts counts_{};
};

}  // namespace whisker::hal::stm32f405
