#pragma once

#include "hal/runtime/registers.hpp"

namespace whisker::hal::mcu {

/// TIMER0 of the nRF51, free-running, 32 bits. Source: nRF51 Series Reference Manual 3.0, chapter 18.
struct NrfTimer {
  static constexpr uint32_t kHertz = 16000000;
  static constexpr uint32_t kPerMillisecond = kHertz / 1000;

  static void start() noexcept {
    reg(kBitMode) = 3;  // 32 bits
    reg(kPrescaler) = 0;
    reg(kStart) = 1;
  }
  static uint32_t now() noexcept {
    reg(kCapture) = 1;
    return reg(kCompare);
  }

 private:
  static constexpr uintptr_t kBase = 0x40008000;
  static constexpr uintptr_t kStart = kBase + 0x000;
  static constexpr uintptr_t kCapture = kBase + 0x040;
  static constexpr uintptr_t kBitMode = kBase + 0x508;
  static constexpr uintptr_t kPrescaler = kBase + 0x510;
  static constexpr uintptr_t kCompare = kBase + 0x540;
};

}  // namespace whisker::hal::mcu
