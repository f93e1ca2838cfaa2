#pragma once

#include <stdint.h>

namespace whisker::hal::pico {

/// The light on the Pico, by 16 sixteenths of a period: a bit is one of them, and the lowest is the first.
class Led {
 public:
  static constexpr uint16_t kOff = 0x0000;
  static constexpr uint16_t kOn = 0xFFFF;
  static constexpr uint16_t kSlow = 0x00FF;    ///< once in 1.6 s
  static constexpr uint16_t kDouble = 0x0033;  ///< two short flashes in 1.6 s
  static constexpr uint16_t kFast = 0x5555;    ///< five times a second
  static constexpr uint16_t kShort = 0x0001;   ///< a flash in 1.6 s
  static constexpr uint32_t kSixteenthMs = 100;

  void show(uint16_t pattern, uint32_t now_ms) noexcept;
};

}  // namespace whisker::hal::pico
