#pragma once

#include <stdint.h>

#include "firmware/can/input_set.hpp"
#include "firmware/can/mission.hpp"
#include "firmware/can/node.hpp"

namespace whisker::can {

enum class OrderState : uint8_t {
  none,
  waiting,  ///< not answered yet: sent again and again
  accepted,
  refused,  ///< or pointless: see for_good()
};

/// The party with the sensors and the wheels, which also gives the missions. Allocates nothing, waits for
/// nothing.
///
///   every millisecond:  node.poll(now);
///   every period:       wheels(node.control());  node.send_set(...);
class BaseNode final : public Node {
 public:
  /// ramp: the change of a wheel's speed in one period with which it brakes, 0.1 mm/s; more than 0.
  BaseNode(hal::CanPort& port, const Identity& identity, int16_t ramp) noexcept;

  void poll(uint32_t now_ms) noexcept;
  /// Sends what was measured at a tick. In lockstep the same tick may be sent again. False: the port did not
  /// take all of it.
  bool send_set(const InputSet& set, Pace pace) noexcept;
  /// Once a period: the speeds that the wheels shall have now. While the robot does not run they go down to
  /// zero by the ramp.
  hal::WheelSpeeds control() noexcept;

  /// Command and status for this tick have come.
  bool answered(uint32_t tick) const noexcept;
  const WheelCommand& command() const noexcept { return command_; }
  const NavStatus& status() const noexcept { return status_; }

  /// Gives an order, and gives it again until it is answered. It ends this node's safe stop; the wheels must
  /// be at rest for that. The robot runs once a start or resume is accepted.
  void give(Order order, const Mission& mission, Pace pace) noexcept;
  OrderState order_state() const noexcept { return order_state_; }

  void request(const ParamRequest& request) noexcept;
  /// The answer to the last request is there.
  bool replied(ParamReply& reply) const noexcept;

 private:
  Heard hear(Kind kind, const hal::CanFrame& frame) noexcept override;
  void forget_peer() noexcept override;
  bool at_rest() const noexcept override { return speeds_.left == 0 && speeds_.right == 0; }
  void hear_command(const WheelCommand& command) noexcept;
  void hear_reply(const MissionReply& reply) noexcept;
  void send_order() noexcept;

  const int16_t ramp_;
  hal::WheelSpeeds speeds_{};
  WheelCommand command_;
  NavStatus status_;
  uint32_t tick_ = 0;
  uint32_t command_seen_ = 0;
  uint8_t period_ms_ = 10;
  bool commanded_ = false;  // a command for this mission has come
  bool status_come_ = false;

  MissionValues values_;
  Order order_ = Order::start;
  OrderState order_state_ = OrderState::none;
  uint8_t mission_ = 0;
  bool order_due_ = false;
  uint32_t ordered_at_ = 0;

  ParamReply reply_;
  bool replied_ = false;
};

}  // namespace whisker::can
