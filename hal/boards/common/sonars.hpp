#pragma once

#include "hal/boards/common/shared.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::hal::mcu {

/// Three HC-SR04, one after another, so that none takes the ping of another for its own. The board has the
/// pins: it triggers the sensor whose turn comes, and tells of each edge of an echo line.
///
/// An HC-SR04 raises its echo line about 0.5 ms after the trigger, and lowers it when the echo returns, or
/// after 38 ms without one. So a line that has risen in time and fallen is the answer of a sensor that works:
/// `ok` if the echo returned within its turn, else `clear`. All else proves nothing and is `invalid`: a line
/// that does not rise in time (dead, unplugged, or high since before), or is still high when its next
/// turn comes.
class Sonars final : public Rangefinders {
 public:
  static constexpr uint32_t kTurnUs = 20000;  ///< a round takes 60 ms, the least that the maker advises
  static constexpr uint32_t kRisesWithinUs = 1000;
  /// Between two calls of take_turn(). After a longer pause, interrupts may have been late, and so the times
  /// of the edges: what was measured meanwhile is `invalid`.
  static constexpr uint32_t kPauseUs = 20000;
  static constexpr int kNone = -1;

  /// In the handler of the edges: the level of this beam's echo line after it.
  void on_edge(int beam, bool high, uint32_t now_us) noexcept {
    Line& line = lines_[beam];
    if (high == line.high) return;
    line.high = high;
    (high ? line.rose_us : line.fell_us) = now_us;
    published_[beam].publish(line);
  }
  /// Every millisecond. The beam to trigger now, by a pulse of 10 us; kNone: not yet.
  int take_turn(uint32_t now_us) noexcept;
  bool read(RangeReadings& out) noexcept override;

 private:
  struct Line {
    uint32_t rose_us = 0;
    uint32_t fell_us = 0;
    bool high = false;
  };
  struct Ping {
    uint32_t at_us = 0;
    bool open = false;  // without an answer yet
    RangeReading reading{0, RangeStatus::stale, UINT8_MAX, 15};
    uint32_t measured_us = 0;
  };
  void hear(int beam, bool paused) noexcept;
  void answer(Ping& ping, RangeStatus status, uint32_t mm = 0) noexcept;

  Line lines_[kBeams];  // of the handler
  Latest<Line> published_[kBeams];
  Ping pings_[kBeams];
  uint32_t now_us_ = 0;
  uint32_t turned_us_ = 0;
  int turn_ = kRight;
};

}  // namespace whisker::hal::mcu
