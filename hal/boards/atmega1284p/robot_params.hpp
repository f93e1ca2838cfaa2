#pragma once

#include "firmware/params.hpp"
#include "hal/boards/common/governor.hpp"

namespace whisker::hal::atmega1284p {

/// The reference body with ultrasonic sensors fired in turn: slow and wide readings, and a tick every 20 ms.
constexpr Params robot_params() noexcept {
  Params p;
  p.safety.period = 20_ms;
  p.safety.lost_after = 2000_ms;
  p.rangefinders.clear_range = 600_mm;  // docs/boards.md
  p.rangefinders.rate_hz = 6;
  p.rangefinders.latency = 20_ms;
  p.rangefinders.cone = 30_deg;
  p.conditioning.stale_after = 500_ms;
  return p;
}

inline constexpr Params kRobotParams = robot_params();
inline constexpr mcu::MotorParams kMotorParams = {};

}  // namespace whisker::hal::atmega1284p
