#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/clock.hpp"

namespace whisker::hal::stm32f405 {

/// Drivers of both motors: a pulse width from TIM1 and two direction inputs each.
class Motors {
 public:
  static constexpr uint32_t kPwmHz = 20000;

  /// Stops the wheels: no pulses, both direction inputs low.
  void start(const Clocks& clocks) noexcept;
  /// +-32767 is full duty, forward positive. 0 brakes: both direction inputs low.
  void drive(int16_t left, int16_t right) noexcept;
  /// Brakes. Needs no driver, so that it also works after a fault of the processor.
  static void cut_off() noexcept;

 private:
  void drive_one(uint8_t wheel, int16_t duty) noexcept;
  uint32_t steps_ = 0;
};

}  // namespace whisker::hal::stm32f405
