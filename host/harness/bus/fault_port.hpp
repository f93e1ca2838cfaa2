#pragma once

#include <cstdint>
#include <deque>

#include "hal/ports/can_queue.hpp"
#include "host/harness/bus/fault_injector.hpp"

namespace whisker::bus {

/// A CanPort on a faulty bus: forwards to another port, with the faults of a schedule. The same seed,
/// schedule and calls give the same faults.
///
/// counts() returns what the owner of a real port would see: `sent` counts frames that left towards the bus,
/// lost later or not; the other counters of the inner port are added.
class FaultPort final : public hal::CanPort {
 public:
  FaultPort(hal::CanPort& inner, Schedule schedule, std::uint64_t seed, Repair repair = nullptr);
  FaultPort(const FaultPort&) = delete;
  FaultPort& operator=(const FaultPort&) = delete;

  /// Sets the control tick for the schedule; 0 before the first call. Never decreases.
  void at_tick(std::uint32_t tick);

  bool send(const hal::CanFrame& frame, std::uint8_t lifetime_ms) noexcept override;
  bool receive(hal::CanFrame& out) noexcept override;
  void poll(std::uint32_t now_ms) noexcept override;
  void restart() noexcept override;
  hal::CanState state() const noexcept override;
  const hal::CanCounts& counts() const noexcept override { return counts_; }
  const Tally& tally() const noexcept { return injector_.tally; }

 private:
  struct Passing {
    hal::CanFrame frame;
    std::uint8_t lifetime_ms;
    std::uint32_t due_tick;
  };
  /// Frames in transit in one direction.
  struct Way {
    std::deque<Passing> late;
    std::deque<Passing> held;
    std::deque<Passing> ready;
  };

  bool on_bus() const noexcept;
  const Fault* active(FaultKind kind) const noexcept;
  void pass(Way& way, const hal::CanFrame& frame, std::uint8_t lifetime_ms, Direction direction);
  void release_late(Way& way);
  void see_state();
  void see_incoming();
  void see_outgoing(std::uint32_t now_ms);
  bool outbid(const hal::CanFrame& frame) const noexcept;
  void add_counts() noexcept;

  hal::CanPort& inner_;
  FaultInjector injector_;
  bool is_off_ = false;
  bool is_down_ = false;
  bool is_restarting_ = false;
  std::uint32_t received_in_tick_ = 0;
  hal::CanOutbox outbox_;
  hal::CanInbox inbox_;
  Way out_;
  Way in_;
  hal::CanCounts counts_;
  hal::CanCounts inner_counts_;  // counters of the inner port that were added
};

}  // namespace whisker::bus
