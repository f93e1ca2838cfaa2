#include "host/run/spec.hpp"

#include <cmath>

namespace whisker {
namespace {

using sim::kPi;

Length length(double metres) {
  return micrometres(static_cast<std::int32_t>(std::floor(metres * 1e6 + 0.5)));
}

}  // namespace

double radians(Angle angle) { return angle.wrapped() * (kPi / 2147483648.0); }

sim::NoiseSpec noise_spec(const Noise& n) {
  return {n.range_sigma_m, n.range_dropout, n.range_false_clear, n.wheel_scale_sigma,
          n.heading_drift_deg_per_sqrt_m * (kPi / 180.0)};
}

sim::RobotSpec robot_spec(const Scenario& scenario) {
  constexpr double kDegree = kPi / 180.0;
  const Sensor& sensor = scenario.sensor;
  sim::RobotSpec spec = sim::robot_spec(scenario.robot);
  if (sensor.incidence_deg < 90) spec.incidence = sensor.incidence_deg * kDegree;
  if (sensor.cone_deg) spec.cone_half_width = *sensor.cone_deg / 2 * kDegree;
  spec.side_angle += sensor.skew_deg * kDegree;
  spec.range_scale = sensor.scale;
  spec.phantom = sensor.phantom;
  spec.crosstalk = sensor.crosstalk;
  return spec;
}

Pose fixed_pose(const sim::Pose& pose) {
  const double turns = pose.heading / (2 * kPi);
  const double fraction = turns - std::floor(turns);
  const std::uint64_t raw = static_cast<std::uint64_t>(std::floor(fraction * 4294967296.0 + 0.5));
  return {{length(pose.at.x), length(pose.at.y)}, Angle::from_raw(static_cast<std::uint32_t>(raw))};
}

}  // namespace whisker
