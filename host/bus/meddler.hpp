#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "host/bus/fault.hpp"
#include "host/worlds/random.hpp"

namespace whisker::bus {

/// What a schedule's faults of frames make of each frame, one after another in the schedule's order.
class Meddler {
 public:
  struct Outcome {
    hal::CanFrame frame;
    std::uint32_t copies;  ///< 0: lost
    std::uint32_t ticks;   ///< late
    bool held;             ///< until the next one has passed
  };

  Meddler(Schedule schedule, std::uint64_t seed, Repair repair);

  /// Draws which faults of the port hold in this tick.
  void at_tick(std::uint32_t tick);
  /// direction: out or in.
  Outcome meddle(const hal::CanFrame& frame, Direction direction);
  /// The first fault of the port of this kind that holds now, in this direction or both; null if none does.
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
