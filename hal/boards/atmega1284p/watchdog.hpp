#pragma once

namespace whisker::hal::atmega1284p {

/// Resets the chip unless fed within a quarter of a second.
class Watchdog {
 public:
  /// Interrupts must still be off: the two writes must come within four cycles.
  void start() noexcept;
  void feed() noexcept { asm volatile("wdr"); }
};

}  // namespace whisker::hal::atmega1284p
