/// What an operator has sent to a guard node: docs/protocol.md.
#pragma once

#include <stdint.h>

#include "firmware/can/operator_messages.hpp"

namespace whisker::can {

/// Nothing counts before the operator has commanded zero since the last order: whoever holds a stick at full
/// speed when the robot may run again must let go of it first.
class OperatorInbox {
 public:
  /// An order was accepted.
  void disarm() noexcept;
  bool armed() const noexcept { return armed_; }

  void on_frame(const VelocityCommand& velocity, uint32_t now_ms) noexcept;
  void on_frame(const VouchRequest& vouch) noexcept;

  /// A Velocity that came since the last call, and counts. age_ms: how long ago.
  bool take(VelocityCommand& velocity, uint32_t now_ms, uint32_t& age_ms) noexcept;
  /// A Vouch that came since the last call, and is no repetition.
  bool take(VouchRequest& vouch) noexcept;

 private:
  VelocityCommand velocity_;
  VouchRequest vouch_;
  uint32_t velocity_at_ = 0;
  bool armed_ = false;
  bool commanded_ = false;  // velocity_ was not taken yet
  bool asked_ = false;      // the same of vouch_
  bool numbered_ = false;   // vouch_ is of this run
};

}  // namespace whisker::can
