#pragma once

#include <stdint.h>

namespace whisker::hal {

/// Measures the cost of code on this target. A target that cannot measure returns 0.
class Meter {
 public:
  /// The current time stamp, in a unit of its own. Always executes the same path.
  virtual uint32_t stamp() noexcept = 0;
  /// The work between two stamps: instructions in an emulator that counts them (ARM, RISC-V). The largest
  /// measurable difference depends on the board and is at least 600,000.
  virtual uint32_t between(uint32_t from, uint32_t to) noexcept = 0;
  /// The deepest stack since the start, in bytes.
  virtual uint32_t deepest_stack() noexcept = 0;

 protected:
  ~Meter() = default;
};

/// The difference of two consecutive stamps.
inline uint32_t overhead(Meter& meter) noexcept {
  const uint32_t from = meter.stamp();
  const uint32_t to = meter.stamp();
  return meter.between(from, to);
}

}  // namespace whisker::hal
