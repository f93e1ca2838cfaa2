#pragma once

#include <stdint.h>

namespace whisker::hal {

/// A millisecond counter for the main loop. The core receives time as an argument.
class Clock {
 public:
  /// Milliseconds since any fixed instant, modulo 2^32, monotonic. Never blocks, never fails.
  virtual uint32_t now_ms() noexcept = 0;

 protected:
  ~Clock() = default;
};

}  // namespace whisker::hal
