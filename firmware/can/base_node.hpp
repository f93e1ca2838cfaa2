#pragma once

#include <stdint.h>

#include "firmware/can/input_set.hpp"
#include "firmware/can/mission.hpp"
#include "firmware/can/node.hpp"

namespace whisker::can {

enum class OrderState : uint8_t {
  none,
  waiting,  ///< not answered yet: repeated
  accepted,
  refused,  ///< or has no effect: see permanent_errors()
};

/// What a calibration ended with, and all values that the controller has.
struct Calibrated : calibration::Values {
  planning::Trouble trouble = planning::Trouble::not_finished;
  storage::Stored stored = storage::Stored::nothing;
};

/// The node with the sensors and the wheels, which also sends the missions. It never allocates or waits.
///
///   every millisecond:  node.poll(now);
///   every period:       wheels(node.control());  node.send_set(...);
class BaseNode final : public Node {
 public:
  /// ramp: change of a wheel's speed per period while it brakes, in 0.1 mm/s; above 0.
  BaseNode(hal::CanPort& port, const Identity& identity, int16_t ramp) noexcept;

  /// Another ramp, from now on.
  void brake_by(int16_t ramp) noexcept { ramp_ = ramp; }

  void poll(uint32_t now_ms) noexcept;
  /// Sends the measurements of a tick. In lockstep, the same tick may be sent again. False: the port did not
  /// accept all of it.
  bool send_set(const InputSet& set, SyncMode sync_mode) noexcept;
  /// Call once per period: the speeds that the wheels must have now. While the robot does not run, they ramp
  /// down to zero.
  hal::WheelSpeeds control() noexcept;

  /// Command and status for this tick have arrived.
  bool answered(uint32_t tick) const noexcept;
  const WheelCommand& command() const noexcept { return command_; }
  const NavStatus& status() const noexcept { return status_; }
  /// The last report; false: none has arrived.
  bool reported(RangeTrustReport& trust) const noexcept;
  bool reported(PoseSigmaReport& sigma) const noexcept;
  /// What the mission that is a calibration ended with; false: it has not all arrived.
  bool calibrated(Calibrated& result) const noexcept;
  /// The answer to the last fix of this mission that was answered; false: none has arrived.
  bool replied(FixReply& reply) const noexcept;

  /// Sends an order and repeats it until it is answered. It ends the safe stop of this node, so the wheels
  /// must be at rest. The robot runs once a start or resume is accepted.
  void give(Order order, const Mission& mission, SyncMode sync_mode) noexcept;
  OrderState order_state() const noexcept { return order_state_; }
  /// The last answer to an order.
  MissionStatus order_status() const noexcept { return order_status_; }

  void request(const ParamRequest& request) noexcept;
  /// The answer to the last request has arrived.
  bool replied(ParamReply& reply) const noexcept;

  /// For RulesSender. False: the port did not accept it.
  bool request(const RulesPart& part) noexcept { return send(part); }
  bool request(const RulesOrder& order) noexcept { return send(order); }
  /// A reply has arrived since the last call.
  bool take(RulesReply& reply) noexcept;

 private:
  FrameResult on_frame(MessageKind kind, const hal::CanFrame& frame) noexcept override;
  void reset_peer() noexcept override;
  bool at_rest() const noexcept override { return speeds_.left == 0 && speeds_.right == 0; }
  void on_command(const WheelCommand& command) noexcept;
  void on_reply(const MissionReply& reply) noexcept;
  void on_report(const CalibrationReport& report) noexcept;
  void send_order() noexcept;

  int16_t ramp_;
  hal::WheelSpeeds speeds_{};
  WheelCommand command_;
  NavStatus status_;
  uint32_t tick_ = 0;
  uint32_t command_seen_ = 0;
  uint8_t period_ms_ = 10;
  bool commanded_ = false;  // a command for this mission has arrived
  bool status_come_ = false;
  RangeTrustReport trust_;
  bool trust_come_ = false;
  PoseSigmaReport sigma_;
  bool sigma_come_ = false;
  FixReply fix_reply_;
  bool fix_replied_ = false;
  Calibrated calibration_;
  uint8_t calibration_seen_ = 0;  // one bit for each quantity

  MissionValues values_;
  Order order_ = Order::start;
  OrderState order_state_ = OrderState::none;
  MissionStatus order_status_ = MissionStatus::accepted;
  uint8_t mission_ = 0;
  bool order_due_ = false;
  uint32_t ordered_at_ = 0;

  ParamReply reply_;
  bool replied_ = false;
  RulesReply rules_reply_;
  bool rules_replied_ = false;
};

}  // namespace whisker::can
