#pragma once

#include <stdint.h>

#include "hal/clock.hpp"

namespace whisker::hal::mcu {

/// Milliseconds from a 32-bit up-counter. Must be read at least once before the counter wraps. `Counter`: a
/// class with static uint32_t now() and constexpr uint32_t kPerMillisecond.
template <class Counter>
class Milliseconds final : public Clock {
 public:
  uint32_t now_ms() noexcept override {
    const uint32_t whole = (Counter::now() - last_) / Counter::kPerMillisecond;
    last_ += whole * Counter::kPerMillisecond;
    return now_ms_ += whole;
  }

 private:
  uint32_t last_ = 0;
  uint32_t now_ms_ = 0;
};

}  // namespace whisker::hal::mcu
