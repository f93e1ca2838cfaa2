#pragma once

#include <stdint.h>

#include "firmware/apps/can/remote_guard.hpp"
#include "firmware/apps/can/remote_robot.hpp"
#include "firmware/can/controller_node.hpp"

namespace whisker::can_app {

/// A guard node: whisker::Guard in the place of the controller. The base's orders let it drive, and an
/// operator on the bus says how fast.
///
///   GuardController controller{port, {1, boot, version, rules}};
///   for (;;) controller.poll(clock.now_ms());
class GuardController {
 public:
  /// longest_command: a Velocity holds for this long, or for GuardParams::command_timeout if that is shorter.
  GuardController(hal::CanPort& port, const can::Identity& identity,
                  Duration longest_command = milliseconds(can::kVelocityLate_ms)) noexcept
      : node_(port, identity, nullptr, &inbox_), longest_command_(longest_command) {}
  GuardController(const GuardController&) = delete;
  GuardController& operator=(const GuardController&) = delete;

  /// As RemoteGuard::assist_by; before the first order.
  void assist_by(const fuzzy::Bilinear::Table& table) noexcept { guard_.assist_by(table); }
  /// Call it every millisecond. True: the guard executed a step; status() is new.
  bool poll(uint32_t now_ms) noexcept;

  const GuardStatus& status() const noexcept { return status_; }
  const can::ControllerNode& node() const noexcept { return node_; }
  can::ControllerNode& node() noexcept { return node_; }

 private:
  void begin(can::Order order) noexcept;
  void take_wishes(Time now, uint32_t now_ms) noexcept;
  void answer(const can::InputSet& set) noexcept;
  void tell(can::GuardReport report, uint32_t now_ms) noexcept;

  can::OperatorInbox inbox_;
  can::ControllerNode node_;
  const Duration longest_command_;
  RemoteGuard guard_;
  GuardStatus status_;
  uint32_t told_at_ = 0;
  bool still_ = false;    // the wheels were not commanded to move since the last order
  bool vouched_ = false;  // a Vouch counted since then
};

}  // namespace whisker::can_app
