#pragma once

#include <stdint.h>

namespace whisker::can {

/// In the order of for_each_message.
enum class MessageKind : uint8_t {
  e_stop,
  sync,
  fault,
  mission,
  mission_reply,
  velocity,
  vouch,
  wheel_command,
  wheel_state,
  range_left,
  range_front,
  range_right,
  nav_status,
  param_request,
  param_reply,
  range_trust,
  pose_sigma,
  gyro,
  fix,
  fix_reply,
  guard_status,
  rules_part,
  rules_order,
  rules_reply,
  calibration,
  heartbeat,
  info,
  info_request,
  diagnostics,
};

}  // namespace whisker::can
