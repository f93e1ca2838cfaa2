/// Both nodes in real time, with their own faults, recorded tick by tick; a test may send additional frames.
#pragma once

#include <memory>
#include <vector>

#include "firmware/apps/can/controller.hpp"
#include "firmware/planning/goal_planner.hpp"
#include "host/harness/bus/scripted_node.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/scenario/robot.hpp"
#include "tests/can/base_side.hpp"

namespace whisker::test {

/// The state of a node at a tick.
struct Seen {
  hal::WheelSpeeds speeds{};
  can::NodeState base = can::NodeState::waiting;
  can::NodeState controller = can::NodeState::waiting;
  std::uint16_t base_errors = 0;
  std::uint16_t controller_errors = 0;
};

/// Turns to both sides, so that the guard knows the ground beside the path, and drives straight ahead at full
/// speed.
class Straight final : public planning::GoalPlanner {
 private:
  void start(const planning::View& view) noexcept override {
    turns_ = 0;
    heading_ = view.pose.heading;
    next();
  }
  void advance(const planning::View& view) noexcept override {
    if (view.settled) next();
  }
  void next() noexcept {
    constexpr Angle kTurns[] = {54_deg, -54_deg, 0_deg};
    if (turns_ < 3) {
      decision_.manoeuvre = {planning::ManoeuvreKind::turn, heading_ + kTurns[turns_++], {}};
    } else {
      decision_.manoeuvre = {planning::ManoeuvreKind::drive, heading_, 100_m};
    }
  }
  Angle heading_;
  int turns_ = 0;
};

class StraightMaker final : public can_app::PlannerMaker {
 public:
  planning::Planner& make(const Params&) noexcept override {
    planner_ = std::make_unique<Straight>();
    return *planner_;
  }

 private:
  std::unique_ptr<Straight> planner_;
};

class Rig {
 public:
  static constexpr std::uint32_t kFault = 800;  ///< first tick of the tests' faults: the robot cruises

  Rig(const Scenario& scenario, bus::Schedule at_base, bus::Schedule at_controller, std::uint64_t seed = 1,
      can_app::PlannerMaker* planners = nullptr)
      : side_(scenario, std::move(at_base), seed),
        controller_port_(side_.wire().attach(), std::move(at_controller), seed + 1, repair),
        controller_(std::make_unique<can_app::Controller>(controller_port_, can::Identity{1, 22, 0},
                                                          planners != nullptr ? *planners : straight_)),
        third(side_.wire(), 3),
        hand(side_.wire(), 1) {
    third.poll(0);
  }

  void give(can::Order order) { side_.give(order); }
  void drive(std::uint32_t ticks) {
    for (std::uint32_t i = 0; i < ticks; ++i) tick();
  }
  /// Completes the handshake, starts the mission and drives until the faults begin.
  void cruise() {
    drive(20);
    give(can::Order::start);
    while (ticks() < kFault) tick();
  }

  const std::vector<Seen>& seen() const { return seen_; }
  const Seen& now() const { return seen_.back(); }
  std::uint32_t ticks() const { return side_.ticks(); }
  can::BaseNode& base() { return side_.node(); }
  can::ControllerNode& controller() { return controller_->node(); }
  const sim::Plant& plant() const { return side_.plant(); }
  bus::FaultPort& base_port() { return side_.port(); }
  bus::FaultPort& controller_port() { return controller_port_; }
  const Status& status() const { return controller_->status(); }
  bus::MemoryBus& wire() { return side_.wire(); }

 private:
  void tick() {
    controller_port_.at_tick(ticks());
    const hal::WheelSpeeds speeds = side_.tick([this](std::uint32_t now_ms) {
      controller_->poll(now_ms);
      third.poll(now_ms);
      hand.poll(now_ms);
    });
    seen_.push_back({speeds, base().state(), controller().state(), base().errors(), controller().errors()});
  }

  BaseSide side_;
  bus::FaultPort controller_port_;
  StraightMaker straight_;
  std::unique_ptr<can_app::Controller> controller_;
  std::vector<Seen> seen_;

 public:
  bus::ScriptedNode third;  ///< of robot 3
  bus::ScriptedNode hand;   ///< the operator; its number is that of the robot
};

}  // namespace whisker::test
