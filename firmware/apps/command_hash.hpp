#pragma once

#include <stdint.h>

#include "hal/types.hpp"

namespace whisker {

/// FNV-1a 64 over wheel commands as int16 little-endian, left first.
class CommandHash {
 public:
  void add(hal::WheelSpeeds command) noexcept {
    add(command.left);
    add(command.right);
  }
  void add(int16_t value) noexcept {
    const auto bits = static_cast<uint16_t>(value);
    byte(static_cast<uint8_t>(bits));
    byte(static_cast<uint8_t>(bits >> 8));
  }
  uint64_t value() const noexcept { return value_; }

 private:
  void byte(uint8_t b) noexcept { value_ = (value_ ^ b) * UINT64_C(0x100000001B3); }
  uint64_t value_ = UINT64_C(0xCBF29CE484222325);
};

}  // namespace whisker
