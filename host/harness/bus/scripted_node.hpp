/// A node on a bus in memory that sends exactly what it is told to.
#pragma once

#include <cstdint>
#include <deque>

#include "firmware/can/codec.hpp"
#include "firmware/can/messages.hpp"
#include "firmware/can/table_hash.hpp"
#include "host/harness/bus/memory_bus.hpp"

namespace whisker::bus {

class ScriptedNode {
 public:
  ScriptedNode(MemoryBus& wire, std::uint8_t node) : port_(wire.attach()), node_(node) {}

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
  /// How many frames of this kind were received, unchecked.
  template <class M>
  int heard() const {
    int n = 0;
    for (const hal::CanFrame& f : heard_) n += f.id >> 4 == can::message_of(M::kKind).function ? 1 : 0;
    return n;
  }
  /// Calls f(message) for each frame of this kind that the codec accepts.
  template <class M, class F>
  void each(const F& f) const {
    for (const hal::CanFrame& frame : heard_) {
      M m;
      if (frame.id >> 4 == can::message_of(M::kKind).function && can::decode(frame, m)) f(m);
    }
  }
  void forget() { heard_.clear(); }
  const std::deque<hal::CanFrame>& frames() const { return heard_; }

 private:
  MemoryPort& port_;
  std::uint8_t node_;
  can::AliveSender alive_[can::kKinds];
  std::deque<hal::CanFrame> heard_;
};

}  // namespace whisker::bus
