#pragma once

#include <stdint.h>

#include "hal/boards/common/shared.hpp"
#include "hal/byte_line.hpp"

namespace whisker::hal::pico {

/// UART0: 8 data bits, no parity, 1 stop bit. No call waits: an interrupt moves the bytes.
class UartLine final : public ByteLine {
 public:
  /// A robot says about 33 KB a second.
  static constexpr uint32_t kBaud = 921600;

  void start() noexcept;

  size_t take(uint8_t* to, size_t room) noexcept override;
  size_t offer(const uint8_t* from, size_t count) noexcept override;
  /// A UART does not see whether a cable is plugged in.
  bool ready() noexcept override { return true; }
  /// Bytes lost since the last call: they came faster than take() was called, or damaged.
  uint8_t collect_lost() noexcept { return lost_.collect(); }

  /// Handler of the UART.
  void on_interrupt() noexcept;

 private:
  static constexpr uint16_t kOutDepth = 1024;
  void fill() noexcept;

  mcu::Ring<uint8_t, 128> received_;
  mcu::Events lost_;
  mcu::Ring<uint8_t, kOutDepth> out_;
};

}  // namespace whisker::hal::pico
