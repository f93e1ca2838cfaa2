#pragma once

#include "hal/boards/atmega1284p/trouble.hpp"
#include "hal/boards/common/shared.hpp"
#include "hal/types.hpp"

namespace whisker::hal::atmega1284p {

/// Both quadrature encoders, by an interrupt at each edge of each of their inputs: about 10 us of it.
class Encoders {
 public:
  explicit Encoders(Troubles& troubles) noexcept : troubles_(troubles) {}
  void start() noexcept;
  /// Call it at least once in 32767 counts of a wheel. False: edges came faster than the loop could read.
  bool read(EncoderCounts& out) noexcept;

  void on_interrupt() noexcept;

 private:
  struct Counters {
    uint16_t left = 0;
    uint16_t right = 0;
  };
  Troubles& troubles_;
  mcu::Latest<Counters> shared_;
  mcu::Events skipped_;
  Counters now_;            // the interrupt's own
  uint8_t pins_ = 0;        // the same
  EncoderCounts counts_{};  // the loop's own
};

}  // namespace whisker::hal::atmega1284p
