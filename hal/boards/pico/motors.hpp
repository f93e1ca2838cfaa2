#pragma once

#include <stdint.h>

namespace whisker::hal::pico {

/// A DRV8833, or a TB6612 with its PWM inputs high: two inputs a motor. Both high brakes, both low lets it
/// coast; the driver sleeps while its enable input is low, as during a reset of the chip.
class Motors {
 public:
  static constexpr uint32_t kPwmHz = 20000;

  /// Wakes the driver; the wheels stand.
  void start() noexcept;
  /// +-32767 is full duty, forward positive. 0 brakes. Between the pulses, the motor brakes too, so its speed
  /// follows the duty.
  void drive(int16_t left, int16_t right) noexcept;
  /// The driver sleeps. Needs no object, so that it also works after a fault of the processor.
  static void cut_off() noexcept;
};

}  // namespace whisker::hal::pico
