/// The queues between the callers of a CanPort and its bus, and the rules of the interface that need no bus.
#pragma once

#include "hal/can_port.hpp"

namespace whisker::hal {

/// Saturates.
inline void count(uint32_t& counter, uint32_t times = 1) noexcept {
  counter = counter > UINT32_MAX - times ? UINT32_MAX : counter + times;
}

/// Whether now_ms is at or after then_ms; valid for times up to 2^31 ms apart.
inline bool reached(uint32_t now_ms, uint32_t then_ms) noexcept { return now_ms - then_ms <= INT32_MAX; }

inline bool well_formed(const CanFrame& frame) noexcept {
  constexpr uint32_t kBaseIds = 0x7FF;
  constexpr uint32_t kExtendedIds = 0x1FFFFFFF;
  return frame.size <= sizeof frame.data && frame.id <= (frame.extended ? kExtendedIds : kBaseIds);
}

/// Frames that wait for the bus, in the order of send(), until they expire.
class CanOutbox {
 public:
  struct Waiting {
    CanFrame frame;
    uint32_t until_ms;
  };

  /// CanPort::send(). on_bus: whether the port is on the bus.
  bool put(const CanFrame& frame, uint8_t lifetime_ms, bool on_bus, CanCounts& counts) noexcept {
    const bool fits =
        waiting_ < CanPort::kSendDepth && lifetime_ms > 0 && lifetime_ms <= CanPort::kLongestLife;
    if (!fits || !on_bus || !well_formed(frame)) {
      count(counts.refused);
      return false;
    }
    queue_[(first_ + waiting_) % CanPort::kSendDepth] = {frame, now_ms_ + lifetime_ms};
    ++waiting_;
    return true;
  }
  /// Drops expired frames and returns their number.
  uint8_t expire(uint32_t now_ms, CanCounts& counts) noexcept {
    now_ms_ = now_ms;
    uint8_t dropped = 0;
    for (; waiting_ > 0 && reached(now_ms, queue_[first_].until_ms); ++dropped) pop();
    count(counts.expired, dropped);
    return dropped;
  }
  void drop_all(CanCounts& counts) noexcept {
    count(counts.expired, waiting_);
    waiting_ = 0;
  }
  /// Null: the queue is empty.
  const Waiting* first() const noexcept { return at(0); }
  /// The frame at this position; null: beyond the end of the queue.
  const Waiting* at(uint8_t behind) const noexcept {
    return behind < waiting_ ? &queue_[(first_ + behind) % CanPort::kSendDepth] : nullptr;
  }
  /// Only if first() is not null.
  void pop() noexcept {
    first_ = static_cast<uint8_t>((first_ + 1) % CanPort::kSendDepth);
    --waiting_;
  }

 private:
  Waiting queue_[CanPort::kSendDepth] = {};
  uint8_t first_ = 0;
  uint8_t waiting_ = 0;
  uint32_t now_ms_ = 0;
};

/// Frames that wait for receive().
class CanInbox {
 public:
  bool full() const noexcept { return waiting_ == CanPort::kReceiveDepth; }
  uint8_t room() const noexcept { return static_cast<uint8_t>(CanPort::kReceiveDepth - waiting_); }
  /// A frame without room is dropped and counted.
  void push(const CanFrame& frame, CanCounts& counts) noexcept {
    if (full()) {
      count(counts.overrun);
      return;
    }
    queue_[(first_ + waiting_) % CanPort::kReceiveDepth] = frame;
    ++waiting_;
  }
  /// CanPort::receive().
  bool pop(CanFrame& out, CanCounts& counts) noexcept {
    if (waiting_ == 0) return false;
    out = queue_[first_];
    first_ = static_cast<uint8_t>((first_ + 1) % CanPort::kReceiveDepth);
    --waiting_;
    count(counts.received);
    return true;
  }

 private:
  CanFrame queue_[CanPort::kReceiveDepth] = {};
  uint8_t first_ = 0;
  uint8_t waiting_ = 0;
};

}  // namespace whisker::hal
