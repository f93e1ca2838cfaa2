#pragma once

#include <cstdint>

namespace whisker::hil {

/// Time, and waiting for bus events.
class Clock {
 public:
  /// In lockstep no time-out applies; longer sleeps leave more of the computer to the other node.
  static constexpr std::uint64_t kNap_us = 1000;

  virtual ~Clock() = default;
  virtual std::uint64_t now_us() = 0;  ///< since any fixed instant, monotonic
  /// Returns after this time, or earlier if a frame may have arrived.
  virtual void wait(std::uint64_t most_us) = 0;

  /// Returns at the latest when now_ms() changes, so that the caller sees each millisecond at its start.
  void wait_a_ms() { wait(1000 - now_us() % 1000); }
  std::uint32_t now_ms() { return static_cast<std::uint32_t>(now_us() / 1000); }
};

}  // namespace whisker::hil
