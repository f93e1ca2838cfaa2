#pragma once

#include "hal/ports/can_queue.hpp"

namespace whisker::hal {

/// Two ports as one, whose ends are on one bus: what is sent goes to both, and what comes from one of them
/// also goes to the other. A port that is not on the bus gets nothing, and holds nothing up. Port: the class
/// of both, which is final, so that its functions are called directly.
template <class Port>
class TwoPorts final : public CanPort {
 public:
  TwoPorts(Port& first, Port& second) noexcept : first_(first), second_(second) {}

  bool send(const CanFrame& frame, uint8_t lifetime_ms) noexcept override {
    const bool to_first = pass(first_, frame, lifetime_ms);
    const bool sent = pass(second_, frame, lifetime_ms) || to_first;
    count(sent ? counts_.sent : counts_.refused);
    return sent;
  }
  bool receive(CanFrame& out) noexcept override {
    if (first_.receive(out)) {
      pass(second_, out, kPassedOnLife);
    } else if (second_.receive(out)) {
      pass(first_, out, kPassedOnLife);
    } else {
      return false;
    }
    count(counts_.received);
    return true;
  }
  void poll(uint32_t now_ms) noexcept override {
    now_ms_ = now_ms;
    first_.poll(now_ms);
    second_.poll(now_ms);
  }
  void restart() noexcept override {
    first_.restart();
    second_.restart();
  }
  CanState state() const noexcept override { return on_bus(second_) ? second_.state() : first_.state(); }
  const CanCounts& counts() const noexcept override { return counts_; }

 private:
  static constexpr uint8_t kPassedOnLife = 50;

  static bool on_bus(const Port& port) noexcept {
    return port.state() == CanState::active || port.state() == CanState::passive;
  }
  bool pass(Port& port, const CanFrame& frame, uint8_t lifetime_ms) noexcept {
    if (!on_bus(port)) return false;
    if (port.send(frame, lifetime_ms)) return true;
    // A burst fills the queue of a slow line, which moves on when it is polled.
    port.poll(now_ms_);
    return port.send(frame, lifetime_ms);
  }

  Port& first_;
  Port& second_;
  CanCounts counts_;
  uint32_t now_ms_ = 0;
};

}  // namespace whisker::hal
