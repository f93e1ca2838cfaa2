#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "host/harness/bus/fault.hpp"
#include "host/harness/worlds/random.hpp"

namespace whisker::bus {

/// Applies the frame faults of a schedule to each frame, in the order of the schedule.
class FaultInjector {
 public:
  struct Outcome {
    hal::CanFrame frame;
    std::uint32_t copies;  ///< 0: lost
    std::uint32_t ticks;   ///< delay
    bool held;             ///< until the next frame has passed
  };

  FaultInjector(Schedule schedule, std::uint64_t seed, Repair repair);

  /// Draws the active port faults of this tick.
  void at_tick(std::uint32_t tick);
  /// direction: out or in.
  Outcome meddle(const hal::CanFrame& frame, Direction direction);
  /// The first active port fault of this kind, in this direction or both; null if there is none.
  const Fault* active(FaultKind kind, Direction direction) const noexcept;
  hal::CanFrame babble(const Fault& fault);

  std::uint32_t tick() const noexcept { return tick_; }
  Tally tally{};

 private:
  struct Memory {
    bool holds = false;
    std::uint32_t burst_left = 0;
    std::map<std::uint32_t, hal::CanFrame> frozen;
  };
  bool in_time(const Fault& fault) const noexcept;
  bool hits(const Fault& fault, Memory& memory, const hal::CanFrame& frame, Direction direction);
  void flip_bit(hal::CanFrame& frame);
  bool change(const Fault& fault, Memory& memory, Outcome& outcome);

  Schedule schedule_;
  std::vector<Memory> memory_;
  worlds::Random random_;
  Repair repair_;
  std::uint32_t tick_ = 0;
};

}  // namespace whisker::bus
