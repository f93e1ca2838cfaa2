#pragma once

#include <cstdint>
#include <initializer_list>

#include "hal/wire.hpp"

namespace whisker {

/// FNV-1a 64 over wheel commands as int16 little-endian, left first.
class CommandHash {
 public:
  void add(hal::WheelSpeeds command) {
    for (const std::int16_t speed : {command.left, command.right}) {
      const auto bits = static_cast<std::uint16_t>(speed);
      byte(bits & 0xFFU);
      byte(bits >> 8U);
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  void byte(unsigned b) { value_ = (value_ ^ b) * 0x100000001B3U; }
  std::uint64_t value_ = 0xCBF29CE484222325U;
};

}  // namespace whisker
