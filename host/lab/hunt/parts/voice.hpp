/// A node on a bus in memory that says exactly what a judge wants.
#pragma once

#include <cstdint>
#include <deque>

#include "firmware/can/codec.hpp"
#include "firmware/can/messages.hpp"
#include "firmware/can/table_hash.hpp"
#include "host/harness/bus/memory_bus.hpp"

namespace whisker::hunt {

class Voice {
 public:
  Voice(bus::MemoryBus& wire, std::uint8_t node) : port_(wire.attach()), node_(node) {}

  template <class M>
  hal::CanFrame frame(const M& m) {
    return can::encode(m, node_, alive_[static_cast<int>(M::kKind)].next());
  }
  template <class M>
  void say(const M& m) {
    send(frame(m));
  }
  void send(const hal::CanFrame& frame) { port_.send(frame, 100); }
  void greet(std::uint16_t boot, can::NodeState state) {
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
  /// Calls f(message) for each frame of this kind that was heard.
  template <class M, class F>
  void each(const F& f) const {
    for (const hal::CanFrame& frame : heard_) {
      M m;
      if (frame.id >> 4 == can::message_of(M::kKind).function && can::decode(frame, m)) f(m);
    }
  }
  template <class M>
  int count() const {
    int n = 0;
    each<M>([&](const M&) { ++n; });
    return n;
  }
  /// The last one; false: none.
  template <class M>
  bool last(M& m) const {
    bool any = false;
    each<M>([&](const M& heard) {
      m = heard;
      any = true;
    });
    return any;
  }
  void forget() { heard_.clear(); }

 private:
  bus::MemoryPort& port_;
  std::uint8_t node_;
  can::AliveSender alive_[can::kKinds];
  std::deque<hal::CanFrame> heard_;
};

}  // namespace whisker::hunt
