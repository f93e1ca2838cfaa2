#pragma once

#include "hal/runtime/registers.hpp"

namespace whisker::hal::mcu {

/// The APB UART of Arm's Cortex-M system design kit. Source: DDI 0479, "APB UART".
template <uintptr_t kBase>
struct CmsdkUart {
  static void start() noexcept {
    reg(kBaudDivider) = 16;  // the minimum; the emulator does not wait
    reg(kControl) = kTransmit | kReceive;
  }
  static bool can_read() noexcept { return (reg(kState) & kFullReceive) != 0; }
  static uint8_t get() noexcept { return static_cast<uint8_t>(reg(kData)); }
  static bool can_write() noexcept { return (reg(kState) & kFullTransmit) == 0; }
  static void put(uint8_t byte) noexcept { reg(kData) = byte; }

 private:
  static constexpr uintptr_t kData = kBase + 0x0;
  static constexpr uintptr_t kState = kBase + 0x4;
  static constexpr uintptr_t kControl = kBase + 0x8;
  static constexpr uintptr_t kBaudDivider = kBase + 0x10;
  static constexpr uint32_t kFullTransmit = 1U << 0;
  static constexpr uint32_t kFullReceive = 1U << 1;
  static constexpr uint32_t kTransmit = 1U << 0;
  static constexpr uint32_t kReceive = 1U << 1;
};

}  // namespace whisker::hal::mcu
