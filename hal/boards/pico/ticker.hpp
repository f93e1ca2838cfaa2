#pragma once

#include <stdint.h>

#include "hal/clock.hpp"

namespace whisker::hal::pico {

/// Time from the timer, which counts microseconds, and an interrupt every millisecond.
class Ticker final : public hal::Clock {
 public:
  void start() noexcept;

  /// Wraps after 71 minutes.
  static uint32_t now_us() noexcept;
  /// Must be called at least once in 71 minutes.
  uint32_t now_ms() noexcept override;

  /// Handler of the alarm.
  void on_interrupt() noexcept;
  /// Sleeps until the next millisecond begins, or returns at once if that has happened since the last call.
  void sleep() noexcept;

 private:
  static constexpr uint32_t kPeriodUs = 1000;
  uint32_t last_us_ = 0;
  uint32_t rest_us_ = 0;
  uint32_t ms_ = 0;
  uint32_t alarm_us_ = 0;
  volatile uint8_t alarms_ = 0;
  uint8_t seen_ = 0;
};

}  // namespace whisker::hal::pico
