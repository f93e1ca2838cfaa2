#pragma once

#include <stdint.h>

#include "hal/boards/pico/trouble.hpp"
#include "hal/types.hpp"

namespace whisker::hal::pico {

/// Both quadrature encoders: two state machines of PIO0 sample their pins every 11 us, so they count up to
/// 90,000 edges a second.
class Encoders {
 public:
  void start() noexcept;
  /// Counts since start(). Waits up to 0.1 ms. False: a state machine does not answer.
  bool read(hal::EncoderCounts& out) noexcept;
  void collect(Troubles& troubles) noexcept;

 private:
  uint16_t not_ready_ = 0;
};

}  // namespace whisker::hal::pico
