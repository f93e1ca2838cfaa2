/// A base, a guard node and an operator, in simulated time.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "firmware/apps/can/guard_controller.hpp"
#include "host/harness/bus/scripted_node.hpp"
#include "tests/can/base_side.hpp"
#include "tests/can/serial_line.hpp"

namespace whisker::test {

class GuardRig {
 public:
  /// line_bytes_per_ms: the guard node is behind a serial line; 0: it is on the bus.
  explicit GuardRig(const Scenario& scenario, bus::Schedule at_base = {}, bus::Schedule at_guard = {},
                    std::uint64_t seed = 1, std::size_t line_bytes_per_ms = 0)
      : side_(scenario, std::move(at_base), seed),
        port_(side_.wire().attach(), std::move(at_guard), seed + 1, repair),
        line_(port_, line_bytes_per_ms),
        serial_(line_bytes_per_ms > 0),
        guard_(std::make_unique<can_app::GuardController>(
            serial_ ? line_.node() : static_cast<hal::CanPort&>(port_), can::Identity{1, 22, 0, 33})),
        hand(side_.wire(), 1) {}

  void give(can::Order order) { side_.give(order); }
  void drive(std::uint32_t ticks) {
    for (std::uint32_t i = 0; i < ticks; ++i) tick();
  }
  /// The handshake, the order to start, a vouch and a Velocity of zero: the next Velocity counts.
  void begin(double vouched_m = 0.35) {
    drive(20);
    give(can::Order::start);
    wish = can::VelocityCommand{};
    drive(10);
    if (vouched_m > 0) hand.say(can::VouchRequest{1, static_cast<std::uint16_t>(vouched_m * 1000)});
    drive(5);
  }
  /// The last GuardStatus on the bus.
  can::GuardReport report() const {
    can::GuardReport report;
    hand.last(report);
    return report;
  }

  const SerialLine& line() const { return line_; }
  double speed() const { return (plant().v_left() + plant().v_right()) / 2; }
  const sim::Plant& plant() const { return side_.plant(); }
  can::BaseNode& base() { return side_.node(); }
  can_app::GuardController& guard() { return *guard_; }
  hal::WheelSpeeds wheels() const { return wheels_; }
  std::uint32_t now_ms() const { return side_.ticks() * 10; }
  /// When the operator sent its last Velocity.
  std::uint32_t said_ms() const { return said_ms_; }

 private:
  void tick() {
    port_.at_tick(side_.ticks());
    wheels_ = side_.tick([this](std::uint32_t now_ms) {
      if (wish && now_ms % every_ms == 0) {
        hand.say(*wish);
        said_ms_ = now_ms;
      }
      if (serial_) line_.carry(now_ms);
      guard_->poll(now_ms);
      hand.poll(now_ms);
    });
  }

  BaseSide side_;
  bus::FaultPort port_;
  SerialLine line_;
  const bool serial_;
  std::unique_ptr<can_app::GuardController> guard_;
  hal::WheelSpeeds wheels_{};
  std::uint32_t said_ms_ = 0;

 public:
  bus::ScriptedNode hand;                    ///< the operator; its number is that of the robot
  std::optional<can::VelocityCommand> wish;  ///< sent every `every_ms`; none: silence
  std::uint32_t every_ms = 20;
};

}  // namespace whisker::test
