/// Drives of a real base from this computer, in the place of its controller.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "firmware/apps/can/remote_robot.hpp"
#include "firmware/can/controller_node.hpp"
#include "firmware/guard.hpp"
#include "host/lab/guard/operator.hpp"

namespace whisker::bench {

/// A controller of the base. No other controller of this robot may be on the bus.
class Seat {
 public:
  Seat(hal::CanPort& port, const can::Identity& identity) : node_(port, identity) {}
  virtual ~Seat() = default;
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;

  /// Every millisecond. True: it drove for one tick.
  bool poll(std::uint32_t now_ms);
  const can::ControllerNode& node() const { return node_; }
  can::ControllerNode& node() { return node_; }
  /// The base has given an order to start.
  bool started() const { return started_; }

 protected:
  virtual void on_order(can::Order order, const can::Mission& mission, const Params& params) = 0;
  virtual void step(const can::InputSet& set) = 0;

 private:
  can::ControllerNode node_;
  bool started_ = false;
};

/// The core drives from where the base says that it stands, but to this goal.
class GoalSeat final : public Seat {
 public:
  /// begins: the base's order to start, with the goal. stepped: each tick.
  struct Listener {
    std::function<void(const can::Mission&, const Params&)> begins;
    std::function<void(const can::InputSet&, const Status&)> stepped;
  };
  GoalSeat(hal::CanPort& port, const can::Identity& identity, can_app::PlannerMaker& planners,
           const planning::Goal& goal, Listener listener)
      : Seat(port, identity),
        robot_(std::make_unique<can_app::RemoteRobot>(planners)),
        goal_(goal),
        listener_(std::move(listener)) {}

  const Status& status() const { return status_; }

 private:
  void on_order(can::Order order, const can::Mission& mission, const Params& params) override;
  void step(const can::InputSet& set) override;

  std::unique_ptr<can_app::RemoteRobot> robot_;
  const planning::Goal goal_;
  Listener listener_;
  Status status_;
};

/// An operator drives under the guard.
class GuardSeat final : public Seat {
 public:
  /// vouched_m: the operator says that nothing stands within this distance of the body's centre. The hand
  /// must outlive it; it sees the estimated pose.
  GuardSeat(hal::CanPort& port, const can::Identity& identity, guard::Operator& hand, double vouched_m)
      : Seat(port, identity), hand_(hand), vouched_m_(vouched_m) {}

  /// From now on the wheels are asked to stand.
  void end() { ended_ = true; }
  /// They were commanded to.
  bool stands() const { return status_.command.left == 0 && status_.command.right == 0; }
  const GuardStatus& status() const { return status_; }
  /// Since the first tick.
  double time_s() const { return time_s_; }

 private:
  void on_order(can::Order order, const can::Mission& mission, const Params& params) override;
  void step(const can::InputSet& set) override;

  guard::Operator& hand_;
  const double vouched_m_;
  can_app::RemoteBoard board_;
  Params params_;
  std::optional<Guard> guard_;
  GuardStatus status_;
  std::optional<std::uint32_t> first_tick_;
  double time_s_ = 0, next_s_ = 0;
  bool ended_ = false;
};

}  // namespace whisker::bench
