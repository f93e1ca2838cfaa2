#pragma once

#include "firmware/params.hpp"
#include "hal/boards/common/governor.hpp"

namespace whisker::hal::stm32f405 {

/// The reference body with VL53L0X sensors: parameters that differ from the defaults.
constexpr Params robot_params() noexcept {
  Params p;
  p.rangefinders.max_range = 1200_mm;
  p.rangefinders.clear_range = 700_mm;  // for a grey target: docs/porting.md
  p.rangefinders.rate_hz = 25;
  p.rangefinders.latency = 40_ms;
  p.conditioning.stale_after = 150_ms;
  return p;
}

inline constexpr Params kRobotParams = robot_params();
inline constexpr mcu::MotorParams kMotorParams = {};

}  // namespace whisker::hal::stm32f405
