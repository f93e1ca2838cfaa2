#pragma once

#include <cstdint>

namespace whisker::hil {

/// Time, and waiting for what the bus may bring.
class Clock {
 public:
  /// In lockstep, where no time-out holds: fewer naps leave more of a computer to the other party.
  static constexpr std::uint64_t kNap_us = 1000;

  virtual ~Clock() = default;
  virtual std::uint64_t now_us() = 0;  ///< since any fixed instant, monotonic
  /// Returns after this time, or earlier when a frame may have come.
  virtual void wait(std::uint64_t most_us) = 0;

  /// Until now_ms() changes at most: who counts milliseconds sees each one when it begins.
  void wait_a_ms() { wait(1000 - now_us() % 1000); }
  std::uint32_t now_ms() { return static_cast<std::uint32_t>(now_us() / 1000); }
};

}  // namespace whisker::hil
