#pragma once

#include <cstdint>
#include <functional>

#include "hal/can_port.hpp"

namespace whisker::hil {

/// Upper bound of the bits of a frame on the bus, with all possible stuff bits and the gap.
constexpr std::uint32_t bits_on_bus(const hal::CanFrame& frame) {
  const std::uint32_t data = frame.remote ? 0U : 8U * frame.size;
  const std::uint32_t stuffed = (frame.extended ? 54U : 34U) + data;
  return stuffed + (stuffed - 1) / 4 + 13;
}

/// Observes a port: every frame that it sends or receives, in this order.
class Tap final : public hal::CanPort {
 public:
  using Listener = std::function<void(const hal::CanFrame&)>;
  Tap(hal::CanPort& port, Listener listener) : port_(port), listener_(std::move(listener)) {}

  bool send(const hal::CanFrame& frame, std::uint8_t lifetime_ms) noexcept override {
    if (!port_.send(frame, lifetime_ms)) return false;
    on_frame(frame);
    return true;
  }
  bool receive(hal::CanFrame& out) noexcept override {
    if (!port_.receive(out)) return false;
    on_frame(out);
    return true;
  }
  void poll(std::uint32_t now_ms) noexcept override { port_.poll(now_ms); }
  void restart() noexcept override { port_.restart(); }
  hal::CanState state() const noexcept override { return port_.state(); }
  const hal::CanCounts& counts() const noexcept override { return port_.counts(); }

 private:
  void on_frame(const hal::CanFrame& frame) noexcept { listener_(frame); }

  hal::CanPort& port_;
  Listener listener_;
};

}  // namespace whisker::hil
