#pragma once

#include "hal/meter.hpp"
#include "hal/runtime/stack.hpp"

namespace whisker::hal::mcu {

/// Counts instructions in QEMU with `-icount shift=10`, where each takes 1024 ns of the counter's time. On
/// hardware it measures time at that scale. `Counter`: as for Milliseconds, with constexpr uint32_t kHertz.
template <class Counter>
class CounterMeter final : public Meter {
 public:
  uint32_t stamp() noexcept override { return Counter::now(); }
  uint32_t between(uint32_t from, uint32_t to) noexcept override {
    return static_cast<uint32_t>((uint64_t{to - from} * kMillion + kPerInstruction / 2) / kPerInstruction);
  }
  uint32_t deepest_stack() noexcept override { return mcu::deepest_stack(); }

 private:
  static constexpr uint64_t kMillion = 1000000;
  static constexpr uint64_t kPerInstruction =
      uint64_t{Counter::kHertz} * 1024 / 1000;  // ticks, in millionths
};

}  // namespace whisker::hal::mcu
