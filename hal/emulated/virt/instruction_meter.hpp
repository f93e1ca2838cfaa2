#pragma once

#include "hal/meter.hpp"
#include "hal/runtime/stack.hpp"

namespace whisker::hal::mcu {

/// Instructions retired, as counted by the hart.
class InstructionMeter final : public Meter {
 public:
  uint32_t stamp() noexcept override {
    uint32_t count;
    asm volatile("csrr %0, minstret" : "=r"(count));
    return count;
  }
  uint32_t between(uint32_t from, uint32_t to) noexcept override { return to - from; }
  uint32_t deepest_stack() noexcept override { return mcu::deepest_stack(); }
};

}  // namespace whisker::hal::mcu
