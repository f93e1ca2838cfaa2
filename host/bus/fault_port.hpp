#pragma once

#include <cstdint>
#include <deque>

#include "hal/ports/can_queue.hpp"
#include "host/bus/meddler.hpp"

namespace whisker::bus {

/// A CanPort on a bad bus: passes on what another port does, with the faults of a schedule. The same seed,
/// schedule and calls give the same faults.
///
/// counts() is what the owner of a real port would see: `sent` is what left towards the bus, lost later or
/// not; what the inner port counts besides is added.
class FaultPort final : public hal::CanPort {
 public:
  FaultPort(hal::CanPort& inner, Schedule schedule, std::uint64_t seed, Repair repair = nullptr);
  FaultPort(const FaultPort&) = delete;
  FaultPort& operator=(const FaultPort&) = delete;

  /// The control tick from now on, which the schedule goes by; 0 before the first call. Never goes back.
  void at_tick(std::uint32_t tick);

  bool send(const hal::CanFrame& frame, std::uint8_t lifetime_ms) noexcept override;
  bool receive(hal::CanFrame& out) noexcept override;
  void poll(std::uint32_t now_ms) noexcept override;
  void restart() noexcept override;
  hal::CanState state() const noexcept override;
  const hal::CanCounts& counts() const noexcept override { return counts_; }
  const Tally& tally() const noexcept { return meddler_.tally; }

 private:
  struct Passing {
    hal::CanFrame frame;
    std::uint8_t lifetime_ms;
    std::uint32_t due_tick;
  };
  /// Frames on their way in one direction.
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
  Meddler meddler_;
  bool is_off_ = false;
  bool is_down_ = false;
  bool is_restarting_ = false;
  std::uint32_t received_in_tick_ = 0;
  hal::CanOutbox outbox_;
  hal::CanInbox inbox_;
  Way out_;
  Way in_;
  hal::CanCounts counts_;
  hal::CanCounts inner_counts_;  // as they were added
};

}  // namespace whisker::bus
