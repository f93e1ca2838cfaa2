#pragma once

#include <stdint.h>

#include "hal/boards/common/shared.hpp"
#include "hal/boards/stm32f405/clock.hpp"

namespace whisker::hal::stm32f405 {

/// USART2: 8 data bits, no parity, 1 stop bit. No call blocks: an interrupt stores received bytes in a ring,
/// and bytes are sent one at a time when there is room.
class Usart {
 public:
  static constexpr uint8_t kReceiveDepth = 64;

  /// baud: up to apb1_hz / 16.
  void start(uint32_t baud, const Clocks& clocks) noexcept;

  /// False: no room now.
  bool offer(uint8_t byte) noexcept;
  /// False: nothing received. Counts bytes lost since the last call.
  bool receive(uint8_t& byte, Troubles& troubles) noexcept;

  /// Interrupt handler of the USART.
  void on_interrupt() noexcept;

 private:
  mcu::Ring<uint8_t, kReceiveDepth> received_;
  mcu::Events lost_;
};

}  // namespace whisker::hal::stm32f405
