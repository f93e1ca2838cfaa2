#pragma once

#include <stdint.h>

#include "hal/boards/common/shared.hpp"
#include "hal/boards/stm32f405/clock.hpp"

namespace whisker::hal::stm32f405 {

/// USART2: 8 data bits, no parity, 1 stop bit. Nothing waits for the line: bytes come in by
/// interrupt and stay in a ring, and go out one at a time when there is room.
class Usart {
 public:
  static constexpr uint8_t kReceiveDepth = 64;

  /// baud: up to apb1_hz / 16.
  void start(uint32_t baud, const Clocks& clocks) noexcept;

  /// False: the line has no room for it now.
  bool offer(uint8_t byte) noexcept;
  /// False: nothing has come. Counts what was lost since the last call.
  bool receive(uint8_t& byte, Troubles& troubles) noexcept;

  /// The USART's interrupt.
  void on_interrupt() noexcept;

 private:
  mcu::Ring<uint8_t, kReceiveDepth> received_;
  mcu::Events lost_;
};

}  // namespace whisker::hal::stm32f405
