#pragma once

#include <stdint.h>

namespace whisker::hal::pico {

/// Resets the chip unless fed in time. After the reset, the motor driver sleeps.
class Watchdog {
 public:
  static constexpr uint32_t kLongestMs = 8388;

  /// timeout_ms: 1..kLongestMs. Also feeds it.
  void start(uint32_t timeout_ms) noexcept;
  void feed() noexcept;

 private:
  uint32_t load_ = 0;
};

}  // namespace whisker::hal::pico
