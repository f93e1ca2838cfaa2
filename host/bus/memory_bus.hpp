#pragma once

#include <cstdint>
#include <deque>

#include "hal/ports/can_queue.hpp"

namespace whisker::bus {

/// The frame with the smaller number wins the bus, as bit by bit on the wire: base identifiers first, then
/// data before remote frames, and base before extended ones that begin alike.
std::uint32_t arbitration(const hal::CanFrame& frame) noexcept;

class MemoryBus;

/// A node of a MemoryBus. Errors do not happen on it: the state is `active` from the start, also after
/// restart(). `sent` counts what reached the bus, be anyone there or not.
class MemoryPort final : public hal::CanPort {
 public:
  explicit MemoryPort(MemoryBus& bus) noexcept : bus_(bus) {}
  MemoryPort(const MemoryPort&) = delete;
  MemoryPort& operator=(const MemoryPort&) = delete;

  bool send(const hal::CanFrame& frame, std::uint8_t lifetime_ms) noexcept override;
  bool receive(hal::CanFrame& out) noexcept override;
  void poll(std::uint32_t now_ms) noexcept override;
  void restart() noexcept override {}
  hal::CanState state() const noexcept override { return hal::CanState::active; }
  const hal::CanCounts& counts() const noexcept override { return counts_; }

 private:
  friend class MemoryBus;
  MemoryBus& bus_;
  hal::CanOutbox outbox_;
  hal::CanInbox inbox_;
  hal::CanCounts counts_;
};

/// A CAN bus in this process's memory. No thread and no clock: poll() of any port moves what waits at all
/// ports, the frame with the highest priority first, to every port but its sender's. The same calls give the
/// same frames in the same order.
class MemoryBus {
 public:
  static constexpr std::uint32_t kUnlimited = UINT32_MAX;

  /// frames_per_ms: what the wire carries in a millisecond of poll()'s time; 4 are about 500 kbit/s.
  explicit MemoryBus(std::uint32_t frames_per_ms = kUnlimited) noexcept : frames_per_ms_(frames_per_ms) {}
  MemoryBus(const MemoryBus&) = delete;
  MemoryBus& operator=(const MemoryBus&) = delete;

  /// A new node; lives as long as the bus. Of two with the same frame the older one wins.
  MemoryPort& attach();

 private:
  friend class MemoryPort;
  void run(std::uint32_t now_ms) noexcept;
  MemoryPort* winner() noexcept;

  std::uint32_t frames_per_ms_;
  std::uint32_t left_ = 0;
  std::uint32_t now_ms_ = 0;
  bool started_ = false;
  std::deque<MemoryPort> ports_;
};

}  // namespace whisker::bus
