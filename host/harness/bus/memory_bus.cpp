#include "host/harness/bus/memory_bus.hpp"

namespace whisker::bus {

std::uint32_t arbitration(const hal::CanFrame& frame) noexcept {
  const std::uint32_t remote = frame.remote ? 1 : 0;
  if (!frame.extended) return frame.id << 21 | remote << 20;
  constexpr std::uint32_t kRecessive = 3U << 19;  // at the positions of a base frame's RTR and IDE
  return (frame.id >> 18) << 21 | kRecessive | (frame.id & 0x3FFFF) << 1 | remote;
}

bool MemoryPort::send(const hal::CanFrame& frame, std::uint8_t lifetime_ms) noexcept {
  return outbox_.put(frame, lifetime_ms, true, counts_);
}

bool MemoryPort::receive(hal::CanFrame& out) noexcept { return inbox_.pop(out, counts_); }

void MemoryPort::poll(std::uint32_t now_ms) noexcept {
  hal::count(counts_.outbid, outbox_.expire(now_ms, counts_));
  bus_.run(now_ms);
}

MemoryPort& MemoryBus::attach() { return ports_.emplace_back(*this); }

MemoryPort* MemoryBus::winner() noexcept {
  MemoryPort* best = nullptr;
  std::uint32_t least = 0;
  for (MemoryPort& port : ports_) {
    const hal::CanOutbox::Waiting* waiting = port.outbox_.first();
    if (waiting == nullptr) continue;
    const std::uint32_t key = arbitration(waiting->frame);
    if (best == nullptr || key < least) {
      best = &port;
      least = key;
    }
  }
  return best;
}

void MemoryBus::run(std::uint32_t now_ms) noexcept {
  // A port whose clock is behind the others' does not advance the time.
  const bool later = started_ && now_ms != now_ms_ && hal::reached(now_ms, now_ms_);
  if (!started_ || later) {
    started_ = true;
    now_ms_ = now_ms;
    left_ = frames_per_ms_;
  }
  while (left_ > 0) {
    MemoryPort* sender = winner();
    if (sender == nullptr) return;
    const hal::CanFrame frame = sender->outbox_.first()->frame;
    sender->outbox_.pop();
    hal::count(sender->counts_.sent);
    for (MemoryPort& port : ports_) {
      if (&port != sender) port.inbox_.push(frame, port.counts_);
    }
    if (frames_per_ms_ != kUnlimited) --left_;
  }
}

}  // namespace whisker::bus
