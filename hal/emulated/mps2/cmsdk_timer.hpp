#pragma once

#include "hal/runtime/registers.hpp"

namespace whisker::hal::mcu {

/// The APB timer of Arm's Cortex-M system design kit, free-running. Source: DDI 0479, "APB timer".
template <uintptr_t kBase, uint32_t kFrequency>
struct CmsdkTimer {
  static constexpr uint32_t kHertz = kFrequency;
  static constexpr uint32_t kPerMillisecond = kHertz / 1000;

  static void start() noexcept {
    reg(kReload) = UINT32_MAX;
    reg(kValue) = UINT32_MAX;
    reg(kControl) = kEnable;
  }
  static uint32_t now() noexcept { return UINT32_MAX - reg(kValue); }

 private:
  static constexpr uintptr_t kControl = kBase + 0x0;
  static constexpr uintptr_t kValue = kBase + 0x4;
  static constexpr uintptr_t kReload = kBase + 0x8;
  static constexpr uint32_t kEnable = 1U << 0;
};

}  // namespace whisker::hal::mcu
