/// How much a tick has computed, the same on every processor.
#pragma once

#include <stdint.h>

namespace whisker {

/// Work of a tick, in units of about a row of the local grid: 100 instructions of a Cortex-M3, 220 of a
/// Cortex-M0+ (docs/porting.md). What a tick does in any case is not counted. Loops whose length depends on
/// the surroundings add to it. A long search takes its next step only while there is time, and the next tick
/// continues it.
class Work {
 public:
  /// Searches end when a tick has done this much,
  static constexpr int32_t kSearches = 420;
  /// and what no command waits for when it has done this much,
  static constexpr int32_t kTick = 600;
  /// but neither before it has done this much, however much the tick did before.
  static constexpr int32_t kLeast = 60;
  /// No tick does more: `whisker hunt` looks for one that does.
  static constexpr int32_t kMost = 3000;

  /// A tick begins.
  void begin() noexcept { done_ = until_ = 0; }
  /// From here on, left() counts. The owner's knowledge stays the same, so observers may call this, and add.
  void begin_searches() const noexcept { limit(kSearches); }
  void begin_rest() const noexcept { limit(kTick); }
  void add(int32_t units) const noexcept { done_ = static_cast<uint16_t>(done_ + units); }
  uint16_t done() const noexcept { return done_; }
  /// What searches may still do; zero or less: they wait for the next tick. Without begin_searches(), they
  /// need not wait.
  int32_t left() const noexcept {
    return until_ == 0 ? INT16_MAX : static_cast<int16_t>((until_ & ~kCutShort) - done_);
  }
  /// A search waits for the next tick: so it is until begin_rest().
  void cut_short() const noexcept { until_ |= kCutShort; }
  bool is_cut_short() const noexcept { return (until_ & kCutShort) != 0; }

 private:
  static constexpr uint16_t kCutShort = 0x8000;  // of until_
  void limit(int32_t most) const noexcept {
    until_ = static_cast<uint16_t>(done_ < most - kLeast ? most : done_ + kLeast);
  }

  mutable uint16_t done_ = 0;
  mutable uint16_t until_ = 0;  // 0: no limit
};

}  // namespace whisker
