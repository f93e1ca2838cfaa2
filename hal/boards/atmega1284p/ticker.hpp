#pragma once

#include "hal/boards/common/shared.hpp"
#include "hal/clock.hpp"

namespace whisker::hal::atmega1284p {

/// Milliseconds from timer 2's interrupt. Call now_ms() at least once in 255 ms.
class Ticker final : public Clock {
 public:
  void start() noexcept;
  uint32_t now_ms() noexcept override { return ms_ += events_.collect(); }

  void on_interrupt() noexcept { events_.happened(); }

 private:
  mcu::Events events_;
  uint32_t ms_ = 0;
};

}  // namespace whisker::hal::atmega1284p
