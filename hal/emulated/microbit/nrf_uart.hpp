#pragma once

#include "hal/runtime/registers.hpp"

namespace whisker::hal::mcu {

/// UART of the nRF51. Source: nRF51 Series Reference Manual 3.0, chapter 29.
struct NrfUart {
  static void start() noexcept {
    reg(kSelectTransmit) = 24;  // the pins of the BBC micro:bit's USB bridge
    reg(kSelectReceive) = 25;
    reg(kBaudRate) = 0x01D7E000;  // 115,200
    reg(kEnable) = 4;
    reg(kStartTransmit) = 1;
    reg(kStartReceive) = 1;
  }
  static bool can_read() noexcept { return reg(kReceived) != 0; }
  static uint8_t get() noexcept {
    reg(kReceived) = 0;
    return static_cast<uint8_t>(reg(kReceive));
  }
  static bool can_write() noexcept { return !sending() || reg(kSent) != 0; }
  static void put(uint8_t byte) noexcept {
    reg(kSent) = 0;
    reg(kTransmit) = byte;
    sending() = true;
  }

 private:
  /// The first byte does not wait for a previous one.
  static bool& sending() noexcept {
    static bool value = false;
    return value;
  }
  static constexpr uintptr_t kBase = 0x40002000;
  static constexpr uintptr_t kStartReceive = kBase + 0x000;
  static constexpr uintptr_t kStartTransmit = kBase + 0x008;
  static constexpr uintptr_t kReceived = kBase + 0x108;
  static constexpr uintptr_t kSent = kBase + 0x11C;
  static constexpr uintptr_t kEnable = kBase + 0x500;
  static constexpr uintptr_t kSelectTransmit = kBase + 0x50C;
  static constexpr uintptr_t kSelectReceive = kBase + 0x514;
  static constexpr uintptr_t kReceive = kBase + 0x518;
  static constexpr uintptr_t kTransmit = kBase + 0x51C;
  static constexpr uintptr_t kBaudRate = kBase + 0x524;
};

}  // namespace whisker::hal::mcu
