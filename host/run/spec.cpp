#include "host/run/spec.hpp"

#include <cmath>

namespace whisker {
namespace {

constexpr double kPi = 3.14159265358979323846;

template <class Tag>
double micro(Unit<Tag> x) {
  return x.raw() * 1e-6;
}
double seconds(Duration t) { return t.raw() * 1e-3; }
Length length(double metres) {
  return micrometres(static_cast<std::int32_t>(std::floor(metres * 1e6 + 0.5)));
}

}  // namespace

double radians(Angle angle) { return angle.wrapped() * (kPi / 2147483648.0); }

sim::RobotSpec robot_spec(const Params& p) {
  sim::RobotSpec s;
  s.radius = micro(p.body.radius);
  s.track = micro(p.body.track);
  s.max_acceleration = micro(p.wheels.max_acceleration);
  s.motor_lag = seconds(p.wheels.motor_lag);
  s.counts_per_m = p.wheels.counts_per_metre;
  s.side_angle = radians(p.rangefinders.side_angle);
  s.cone_half_width = radians(p.rangefinders.cone) / 2;
  s.min_range = micro(p.rangefinders.min_range);
  s.max_range = micro(p.rangefinders.max_range);
  s.offset = micro(p.rangefinders.offset);
  s.rate_hz = p.rangefinders.rate_hz;
  s.latency_s = seconds(p.rangefinders.latency);
  s.period_s = seconds(p.safety.period);
  return s;
}

sim::NoiseSpec noise_spec(const Noise& n) {
  return {n.range_sigma_m, n.range_dropout, n.range_false_clear, n.wheel_scale_sigma,
          n.heading_drift_deg_per_sqrt_m * (kPi / 180.0)};
}

Pose fixed_pose(const sim::Pose& pose) {
  const double turns = pose.heading / (2 * kPi);
  const double fraction = turns - std::floor(turns);
  const std::uint64_t raw = static_cast<std::uint64_t>(std::floor(fraction * 4294967296.0 + 0.5));
  return {{length(pose.at.x), length(pose.at.y)}, Angle::from_raw(static_cast<std::uint32_t>(raw))};
}

}  // namespace whisker
