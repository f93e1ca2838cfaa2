/// Parameters of a robot from its body, its wheels and its three sensors, none of which has a default.
#pragma once

#include "firmware/params.hpp"

namespace whisker {

/// Three rangefinders of one type, and how long their readings count.
struct Sensors {
  RangefinderParams rangefinders;
  Duration stale_after;
};

constexpr Params params_of(const BodyParams& body, const WheelParams& wheels,
                           const Sensors& sensors) noexcept {
  Params params;
  params.body = body;
  params.wheels = wheels;
  params.rangefinders = sensors.rangefinders;
  params.conditioning.stale_after = sensors.stale_after;
  return params;
}

/// HC-SR04 sonars, one ahead and one to each side at this angle, each measuring 20 times a second. Within
/// 0.6 m the cone is at least 36 degrees wide; walls seen beyond 40 degrees give no echo. check() refuses an
/// angle at which walls ahead stay unseen, below 32 degrees; from 37 on, 5 degrees are to spare. The figures
/// are those of host/robots/hc-sr04.toml.
constexpr Sensors hc_sr04(Angle side_angle) noexcept {
  Sensors s{{}, 250_ms};
  s.rangefinders.side_angle = side_angle;
  s.rangefinders.cone = 36_deg;
  s.rangefinders.clear_range = 600_mm;
  s.rangefinders.rate_hz = 20;
  s.rangefinders.latency = 50_ms;
  s.rangefinders.incidence = 40_deg;
  return s;
}

/// VL53L0X time-of-flight sensors with their default timing, which see a grey target to 0.7 m:
/// host/robots/vl53l0x.toml.
constexpr Sensors vl53l0x(Angle side_angle) noexcept {
  Sensors s{{}, 150_ms};
  s.rangefinders.side_angle = side_angle;
  s.rangefinders.max_range = 1200_mm;
  s.rangefinders.clear_range = 700_mm;
  s.rangefinders.rate_hz = 25;
  s.rangefinders.latency = 40_ms;
  s.rangefinders.incidence = 80_deg;
  return s;
}

/// VL53L1X time-of-flight sensors, which see walls at almost any angle: host/robots/vl53l1x.toml.
constexpr Sensors vl53l1x(Angle side_angle) noexcept {
  Sensors s{{}, 100_ms};
  s.rangefinders.side_angle = side_angle;
  s.rangefinders.cone = 27_deg;
  s.rangefinders.max_range = 1300_mm;
  s.rangefinders.latency = 40_ms;
  s.rangefinders.incidence = 80_deg;
  return s;
}

}  // namespace whisker
