#pragma once

#include <stdint.h>

#include "hal/mcu/common/shared.hpp"
#include "hal/mcu/stm32f405/clock.hpp"

namespace whisker::stm32f405 {

/// USART2: 8 data bits, no parity, 1 stop bit. Bytes come in by interrupt and wait in a ring.
class Usart {
 public:
  static constexpr uint8_t kReceiveDepth = 64;

  /// baud: up to apb1_hz / 16.
  void start(uint32_t baud, const Clocks& clocks) noexcept;

  /// Waits for room: at most about three bytes' time. False: counted, and the byte is dropped.
  bool send(uint8_t byte, Troubles& troubles) noexcept;
  void send(const char* text, Troubles& troubles) noexcept;
  /// In decimal.
  void send_number(uint32_t number, Troubles& troubles) noexcept;
  /// False: nothing has come. Counts what was lost since the last call.
  bool receive(uint8_t& byte, Troubles& troubles) noexcept;

  /// The USART's interrupt.
  void on_interrupt() noexcept;

 private:
  uint32_t core_hz_ = 0;
  uint32_t byte_us_ = 0;
  mcu::Ring<uint8_t, kReceiveDepth> received_;
  mcu::Events lost_;
};

}  // namespace whisker::stm32f405
