#pragma once

#include <stdint.h>

namespace whisker::hal::atmega1284p {

/// Both motors' drivers: a pulse width from timer 0, 7.8 kHz and 8 bits, and two direction inputs each.
class Motors {
 public:
  /// At rest.
  void start() noexcept;
  /// +-32767 is full duty, forward positive. 0 brakes: both direction inputs low.
  void drive(int16_t left, int16_t right) noexcept;
};

}  // namespace whisker::hal::atmega1284p
