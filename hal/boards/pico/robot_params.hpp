#pragma once

#include "firmware/params/presets.hpp"
#include "hal/boards/common/governor.hpp"

namespace whisker::hal::pico {

/// The robot of the build page: its parameters until an operator commits others.
constexpr Params robot_params() noexcept {
  const BodyParams body{90_mm, 30_mm, 140_mm};
  const WheelParams wheels{300_mm_per_s, 1000_mm_per_s2, 3000_mrad_per_s, 50_ms, 14324};
  return params_of(body, wheels, vl53l0x(30_deg));
}

inline constexpr Params kRobotParams = robot_params();

/// The feed-forward of the speed controllers: wheel_speed_max_mps is three quarters of the speed at full
/// duty.
constexpr mcu::MotorParams motor_of(const Params& params) noexcept {
  mcu::MotorParams motor;
  const int32_t tenths = params.wheels.max_speed.raw() / 100 * 4 / 3;
  motor.full_speed = static_cast<int16_t>(tenths < INT16_MAX ? tenths : INT16_MAX);
  motor.counts_per_metre = params.wheels.counts_per_metre;
  return motor;
}

}  // namespace whisker::hal::pico
