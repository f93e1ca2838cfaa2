/// A node that sends exactly what the test says.
#pragma once

#include <deque>
#include <functional>

#include "firmware/can/codec.hpp"
#include "firmware/can/table_hash.hpp"
#include "host/harness/bus/memory_bus.hpp"

namespace whisker::test {

class Party {
 public:
  Party(bus::MemoryBus& wire, std::uint8_t node) : port_(wire.attach()), node_(node) {}

  template <class M>
  hal::CanFrame frame(const M& m) {
    return can::encode(m, node_, alive_[static_cast<int>(M::kKind)].next());
  }
  template <class M>
  void say(const M& m) {
    send(frame(m));
  }
  void send(const hal::CanFrame& frame) { port_.send(frame, 100); }
  void greet(std::uint16_t boot, can::NodeState state = can::NodeState::ready) {
    can::Heartbeat beat;
    beat.boot = boot;
    beat.state = state;
    say(beat);
    say(can::Info{can::InfoPart::table_hash, boot, can::kTableHash});
  }

  void poll(std::uint32_t now_ms) {
    port_.poll(now_ms);
    hal::CanFrame frame{};
    while (port_.receive(frame)) heard_.push_back(frame);
  }
  /// The last received frame of this kind, unchecked.
  template <class M>
  bool last(M& m) const {
    for (auto f = heard_.rbegin(); f != heard_.rend(); ++f) {
      if (f->id >> 4 == can::message_of(M::kKind).function) return can::decode(*f, m);
    }
    return false;
  }
  template <class M>
  int heard() const {
    int n = 0;
    for (const hal::CanFrame& f : heard_) n += f.id >> 4 == can::message_of(M::kKind).function ? 1 : 0;
    return n;
  }
  void forget() { heard_.clear(); }
  const std::deque<hal::CanFrame>& frames() const { return heard_; }

 private:
  bus::MemoryPort& port_;
  std::uint8_t node_;
  can::AliveSender alive_[can::kKinds];
  std::deque<hal::CanFrame> heard_;
};

}  // namespace whisker::test
