/// Both nodes in one process, on a memory bus, in simulated time.
#pragma once

#include <deque>
#include <functional>

#include "firmware/apps/can/controller.hpp"
#include "host/harness/bus/memory_bus.hpp"
#include "host/harness/hil/bus_pilot.hpp"
#include "host/harness/hil/planners.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/worlds/random.hpp"

namespace whisker::test {

/// Slowdowns, in the base's waits of one millisecond.
struct Slowness {
  std::uint32_t controller = 1;      ///< polled once in so many
  std::uint32_t base_stalls = 0;     ///< the base pauses after so many; 0: never
  std::uint64_t stall_us = 1000000;  ///< longer than the heartbeat time-out
};

/// Each wait lasts one millisecond, in which the controller is polled.
class SharedTime final : public hil::Clock {
 public:
  explicit SharedTime(std::function<void(std::uint32_t now_ms)> others, const Slowness& slowness = {})
      : others_(std::move(others)), slowness_(slowness) {}
  std::uint64_t now_us() override { return now_us_; }
  void wait(std::uint64_t) override {
    ++waits_;
    now_us_ += 1000;
    if (waits_ % slowness_.controller == 0) others_(now_ms());
    if (slowness_.base_stalls > 0 && waits_ % slowness_.base_stalls == 0) now_us_ += slowness_.stall_us;
  }

 private:
  std::uint64_t now_us_ = 0;
  std::uint64_t waits_ = 0;
  std::function<void(std::uint32_t)> others_;
  const Slowness slowness_;
};

/// Drops one of fifty sent frames.
class LossyPort final : public hal::CanPort {
 public:
  LossyPort(hal::CanPort& port, std::uint64_t seed) : port_(port), random_(seed) {}
  bool send(const hal::CanFrame& frame, std::uint8_t lifetime_ms) noexcept override {
    if (!random_.chance(0.02)) return port_.send(frame, lifetime_ms);
    ++dropped_;
    return true;
  }
  bool receive(hal::CanFrame& out) noexcept override { return port_.receive(out); }
  void poll(std::uint32_t now_ms) noexcept override { port_.poll(now_ms); }
  void restart() noexcept override { port_.restart(); }
  hal::CanState state() const noexcept override { return port_.state(); }
  const hal::CanCounts& counts() const noexcept override { return port_.counts(); }
  std::uint64_t dropped() const { return dropped_; }

 private:
  hal::CanPort& port_;
  worlds::Random random_;
  std::uint64_t dropped_ = 0;
};

/// Behind a line that sends only at multiples of `every_ms`, and loses nothing.
class StutteringPort final : public hal::CanPort {
 public:
  StutteringPort(hal::CanPort& port, std::uint32_t every_ms) : port_(port), every_ms_(every_ms) {}
  bool send(const hal::CanFrame& frame, std::uint8_t lifetime_ms) noexcept override {
    return port_.send(frame, lifetime_ms);
  }
  bool receive(hal::CanFrame& out) noexcept override {
    if (let_out_.empty()) return false;
    out = let_out_.front();
    let_out_.pop_front();
    return true;
  }
  void poll(std::uint32_t now_ms) noexcept override {
    port_.poll(now_ms);
    for (hal::CanFrame frame{}; port_.receive(frame);) kept_.push_back(frame);
    if (now_ms / every_ms_ == turn_) return;
    turn_ = now_ms / every_ms_;
    let_out_.insert(let_out_.end(), kept_.begin(), kept_.end());
    kept_.clear();
  }
  void restart() noexcept override { port_.restart(); }
  hal::CanState state() const noexcept override { return port_.state(); }
  const hal::CanCounts& counts() const noexcept override { return port_.counts(); }

 private:
  hal::CanPort& port_;
  const std::uint32_t every_ms_;
  std::uint32_t turn_ = 0;
  std::deque<hal::CanFrame> kept_;
  std::deque<hal::CanFrame> let_out_;
};

struct LoopResult {
  RunResult result;
  hil::Figures figures;
};

/// A run over the bus. others: other nodes, polled with the controller.
inline LoopResult drive_over_bus(
    const Scenario& scenario, PlannerKind kind, can::SyncMode sync_mode, hal::CanPort& base_port,
    hal::CanPort& controller_port, const Slowness& slowness = {},
    const std::function<void(std::uint32_t now_ms)>& others = [](std::uint32_t) {}) {
  hil::HostPlanners planners(kind);
  can_app::Controller controller(controller_port, {1, 77, 0}, planners);
  SharedTime time(
      [&](std::uint32_t now_ms) {
        controller.poll(now_ms);
        others(now_ms);
      },
      slowness);
  LoopResult out;
  hil::BusOptions bus;
  bus.sync_mode = sync_mode;
  bus.resend_ms = 3;
  RunOptions options;
  options.pilot = hil::bus_pilot(base_port, time, bus, out.figures);
  out.result = run(scenario, options);
  return out;
}

}  // namespace whisker::test
