#pragma once

#include <stdint.h>

namespace whisker::hal::mcu {

/// The UART of QEMU's virt board, a 16550.
struct Ns16550 {
  static bool can_read() noexcept { return (at(kLineStatus) & kDataReady) != 0; }
  static uint8_t get() noexcept { return at(kData); }
  static bool can_write() noexcept { return (at(kLineStatus) & kTransmitEmpty) != 0; }
  static void put(uint8_t byte) noexcept { at(kData) = byte; }

 private:
  static volatile uint8_t& at(uintptr_t offset) noexcept {
    return *reinterpret_cast<volatile uint8_t*>(kBase + offset);
  }
  static constexpr uintptr_t kBase = 0x10000000;
  static constexpr uintptr_t kData = 0;
  static constexpr uintptr_t kLineStatus = 5;
  static constexpr uint8_t kDataReady = 1U << 0;
  static constexpr uint8_t kTransmitEmpty = 1U << 5;
};

}  // namespace whisker::hal::mcu
