#pragma once

#include <stdint.h>

namespace whisker::hal {

/// What code costs on this target. A target that cannot tell answers 0.
class Meter {
 public:
  /// The instant, in a unit of its own. Always takes the same path.
  virtual uint32_t stamp() noexcept = 0;
  /// The work from one stamp to a later one: instructions in an emulator that counts them (ARM, RISC-V),
  /// cycles where they are exact (AVR). The most that can be told apart is the board's affair, at least
  /// 600,000.
  virtual uint32_t between(uint32_t from, uint32_t to) noexcept = 0;
  /// The deepest stack since the start, bytes.
  virtual uint32_t deepest_stack() noexcept = 0;

 protected:
  ~Meter() = default;
};

/// What two stamps with nothing between them are apart.
inline uint32_t overhead(Meter& meter) noexcept {
  const uint32_t from = meter.stamp();
  const uint32_t to = meter.stamp();
  return meter.between(from, to);
}

}  // namespace whisker::hal
