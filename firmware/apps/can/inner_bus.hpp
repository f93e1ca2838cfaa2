#pragma once

#include "hal/can_port.hpp"
#include "hal/ports/can_queue.hpp"

namespace whisker::can_app {

/// A bus inside of one program, for a controller and a base on the same chip, with a port to the outside
/// where every frame can be seen, and from where others may send. Without a port to the outside, it works
/// alike.
class InnerBus {
 public:
  enum Seat : int { kController, kBase };

  explicit InnerBus(hal::CanPort& outside) noexcept
      : outside_(outside), seats_{Port(*this, kController), Port(*this, kBase)} {}
  InnerBus(const InnerBus&) = delete;
  InnerBus& operator=(const InnerBus&) = delete;

  hal::CanPort& port(Seat seat) noexcept { return seats_[seat]; }

 private:
  static constexpr int kSeats = 2;

  /// A frame has arrived when send() returns, so none waits, and none is ever lost but in a full inbox.
  class Port final : public hal::CanPort {
   public:
    Port(InnerBus& bus, Seat seat) noexcept : bus_(bus), seat_(seat) {}
    bool send(const hal::CanFrame& frame, uint8_t lifetime_ms) noexcept override {
      if (!hal::well_formed(frame) || lifetime_ms == 0 || lifetime_ms > kLongestLife) {
        hal::count(counts_.refused);
        return false;
      }
      bus_.spread(frame, lifetime_ms, seat_);
      hal::count(counts_.sent);
      return true;
    }
    bool receive(hal::CanFrame& out) noexcept override { return inbox_.pop(out, counts_); }
    void poll(uint32_t now_ms) noexcept override { bus_.poll(now_ms); }
    void restart() noexcept override {}
    hal::CanState state() const noexcept override { return hal::CanState::active; }
    const hal::CanCounts& counts() const noexcept override { return counts_; }

   private:
    friend class InnerBus;
    InnerBus& bus_;
    const Seat seat_;
    hal::CanInbox inbox_;
    hal::CanCounts counts_;
  };

  void spread(const hal::CanFrame& frame, uint8_t lifetime_ms, Seat from) noexcept {
    for (Port& port : seats_) {
      if (port.seat_ != from) port.inbox_.push(frame, port.counts_);
    }
    // A tick fills the queue of a slow line, which moves on when it is polled.
    if (!outside_.send(frame, lifetime_ms)) {
      outside_.poll(now_ms_);
      outside_.send(frame, lifetime_ms);
    }
  }
  void poll(uint32_t now_ms) noexcept {
    now_ms_ = now_ms;
    outside_.poll(now_ms);
    hal::CanFrame frame;
    while (!seats_[kController].inbox_.full() && !seats_[kBase].inbox_.full() && outside_.receive(frame)) {
      for (Port& port : seats_) port.inbox_.push(frame, port.counts_);
    }
  }

  hal::CanPort& outside_;
  Port seats_[kSeats];
  uint32_t now_ms_ = 0;
};

}  // namespace whisker::can_app
