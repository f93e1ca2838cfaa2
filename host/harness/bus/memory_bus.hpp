#pragma once

#include <cstdint>
#include <deque>

#include "hal/ports/can_queue.hpp"

namespace whisker::bus {

/// Arbitration order, as on the wire: the lower number wins. Base identifiers come first, then data before
/// remote frames, and base before extended frames with the same prefix.
std::uint32_t arbitration(const hal::CanFrame& frame) noexcept;

class MemoryBus;

/// A node of a MemoryBus. The bus has no errors: the state is `active` from the start, also after restart().
/// `sent` counts the frames that reached the bus, with or without a receiver.
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

/// A CAN bus in the memory of this process, without threads or clock: poll() of any port moves the frames of
/// all ports, the frame with the highest priority first, to every port except its sender. The same calls give
/// the same frames in the same order.
class MemoryBus {
 public:
  static constexpr std::uint32_t kUnlimited = UINT32_MAX;

  /// frames_per_ms: capacity of the wire per millisecond of poll() time; 4 is about 500 kbit/s.
  explicit MemoryBus(std::uint32_t frames_per_ms = kUnlimited) noexcept : frames_per_ms_(frames_per_ms) {}
  MemoryBus(const MemoryBus&) = delete;
  MemoryBus& operator=(const MemoryBus&) = delete;

  /// A new node; lives as long as the bus. For equal frames, the older node wins.
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
