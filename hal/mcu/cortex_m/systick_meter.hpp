#pragma once

#include "hal/mcu/common/registers.hpp"
#include "hal/mcu/common/stack.hpp"
#include "hal/meter.hpp"

namespace whisker::hal::mcu {

/// Instructions, in QEMU with `-icount shift=10`, where each takes 1024 ns and SysTick runs with the core's clock.
/// Exact while two calls lie less than 2^24 ticks apart. On hardware it counts cycles, at another scale.
/// kHertz: the core's clock in the emulator.
template <uint32_t kHertz>
class SysTickMeter final : public Meter {
 public:
  void start() noexcept {
    reg(kReload) = kMask;
    reg(kCurrent) = 0;
    reg(kControl) = kEnable | kCoreClock;
  }

  uint32_t stamp() noexcept override { return reg(kCurrent); }
  uint32_t between(uint32_t from, uint32_t to) noexcept override {
    return static_cast<uint32_t>((((from - to) & kMask) * kMillion + kPerInstruction / 2) / kPerInstruction);
  }
  uint32_t deepest_stack() noexcept override { return mcu::deepest_stack(); }

 private:
  static constexpr uintptr_t kControl = 0xE000E010;
  static constexpr uintptr_t kReload = 0xE000E014;
  static constexpr uintptr_t kCurrent = 0xE000E018;
  static constexpr uint32_t kEnable = 1U << 0;
  static constexpr uint32_t kCoreClock = 1U << 2;
  static constexpr uint32_t kMask = 0xFFFFFF;
  /// Ticks an instruction, in millionths.
  static constexpr uint64_t kPerInstruction = uint64_t{kHertz} * 1024 / 1000;
  static constexpr uint64_t kMillion = 1000000;
};

}  // namespace whisker::hal::mcu
