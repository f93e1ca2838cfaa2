/// Both nodes in real time, with their own faults, recorded tick by tick; a test may send additional frames.
#pragma once

#include <memory>
#include <vector>

#include "firmware/apps/can/base.hpp"
#include "firmware/apps/can/controller.hpp"
#include "firmware/planning/goal_planner.hpp"
#include "host/bus/fault_port.hpp"
#include "host/bus/memory_bus.hpp"
#include "host/run/runner.hpp"
#include "host/run/sim_world.hpp"
#include "host/run/spec.hpp"
#include "host/scenario/load.hpp"
#include "host/scenario/robot.hpp"
#include "host/sim/sim_board.hpp"
#include "tests/can/party.hpp"

namespace whisker::test {

/// The state of a node at a tick.
struct Seen {
  hal::WheelSpeeds speeds{};
  can::NodeState base = can::NodeState::waiting;
  can::NodeState controller = can::NodeState::waiting;
  std::uint16_t base_errors = 0;
  std::uint16_t controller_errors = 0;
};

inline Scenario open_ground() {
  return parse_scenario("name = \"open\"\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 30.0\ny_m = 0.0\n",
                        "open.toml");
}

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
    constexpr Angle kTurns[] = {50_deg, -50_deg, 0_deg};
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

inline void repair(hal::CanFrame& frame) {
  if (frame.size > 0) frame.data[0] = can::crc_of(frame.id, frame.data, frame.size);
}

class Rig {
 public:
  static constexpr std::uint32_t kFault = 800;  ///< first tick of the tests' faults: the robot cruises

  Rig(const Scenario& scenario, bus::Schedule at_base, bus::Schedule at_controller, std::uint64_t seed = 1,
      can_app::PlannerMaker* planners = nullptr)
      : scenario_(scenario),
        world_(scenario_),
        plant_(world_.view(), robot_spec(scenario_), noise_spec(scenario_.noise), scenario_.seed,
               scenario_.start),
        board_(plant_),
        base_port_(wire_.attach(), std::move(at_base), seed, repair),
        controller_port_(wire_.attach(), std::move(at_controller), seed + 1, repair),
        node_(base_port_, {1, 11, 0}, 100),
        base_(node_, board_, board_),
        controller_(std::make_unique<can_app::Controller>(controller_port_, can::Identity{1, 22, 0},
                                                          planners != nullptr ? *planners : straight_)),
        third(wire_, 3) {
    third.poll(0);
  }

  void give(can::Order order) {
    node_.give(order, {fixed_pose(scenario_.start), fixed_goal(scenario_.goal)}, can::SyncMode::real_time);
  }
  void drive(std::uint32_t ticks) {
    for (std::uint32_t i = 0; i < ticks; ++i) tick();
  }
  /// Completes the handshake, starts the mission and drives until the faults begin.
  void cruise() {
    drive(20);
    give(can::Order::start);
    while (tick_ < kFault) tick();
  }

  const std::vector<Seen>& seen() const { return seen_; }
  const Seen& now() const { return seen_.back(); }
  std::uint32_t ticks() const { return tick_; }
  can::BaseNode& base() { return node_; }
  can::ControllerNode& controller() { return controller_->node(); }
  const sim::Plant& plant() const { return plant_; }
  bus::FaultPort& base_port() { return base_port_; }
  bus::FaultPort& controller_port() { return controller_port_; }
  const Status& status() const { return controller_->status(); }

 private:
  void tick() {
    base_port_.at_tick(tick_);
    controller_port_.at_tick(tick_);
    base_.measure(tick_, 10);
    base_.publish(can::SyncMode::real_time);
    for (int ms = 0; ms < 10; ++ms) {
      ++now_ms_;
      node_.poll(now_ms_);
      controller_->poll(now_ms_);
      third.poll(now_ms_);
    }
    node_.poll(now_ms_);
    const hal::WheelSpeeds speeds = base_.drive();
    seen_.push_back({speeds, node_.state(), controller().state(), node_.errors(), controller().errors()});
    plant_.advance();
    ++tick_;
  }

  const Scenario scenario_;
  SimWorld world_;
  sim::Plant plant_;
  hal::SimBoard board_;
  bus::MemoryBus wire_;
  bus::FaultPort base_port_;
  bus::FaultPort controller_port_;
  StraightMaker straight_;
  can::BaseNode node_;
  can_app::Base base_;
  std::unique_ptr<can_app::Controller> controller_;
  std::vector<Seen> seen_;
  std::uint32_t tick_ = 0;
  std::uint32_t now_ms_ = 0;

 public:
  Party third;  ///< of robot 3
};

}  // namespace whisker::test
