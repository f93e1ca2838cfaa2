#include "host/harness/run/spec.hpp"

#include <cmath>

#include "hal/types.hpp"

namespace whisker {
namespace {

using sim::kPi;

constexpr double kDegree = kPi / 180.0;

Length length(double metres) {
  return micrometres(static_cast<std::int32_t>(std::floor(metres * 1e6 + 0.5)));
}

void set_width(const Sensor& sensor, sim::RobotSpec& spec) {
  for (sim::BeamSpec& beam : spec.beams) {
    if (sensor.cone_deg) beam.cone_half_width = *sensor.cone_deg / 2 * kDegree;
  }
  if (sensor.cone_far_deg) spec.cone_far_half_width = *sensor.cone_far_deg / 2 * kDegree;
  spec.beams[hal::kLeft].angle += sensor.skew_deg * kDegree;
  spec.beams[hal::kRight].angle -= sensor.skew_deg * kDegree;
}

/// If the driver says clear beyond the range that the robot believes, a longer one of the sensor only widens
/// the taper and the reach in ambient light.
void set_reach(const Sensor& sensor, sim::RobotSpec& spec) {
  double believed = 0;
  for (const sim::BeamSpec& beam : spec.beams) believed = std::fmax(believed, beam.max_range);
  const double reach = sensor.max_range_m.value_or(believed);
  const double share = echo_share(sensor);
  spec.taper_range = reach;
  if (share < 1) spec.echo_range = reach * share;
  for (sim::BeamSpec& beam : spec.beams) {
    beam.max_range = sensor.far_is == Far::distance ? reach : std::fmin(reach, beam.max_range);
    beam.min_range = sensor.min_range_m.value_or(beam.min_range);
  }
  spec.soft_range = sensor.soft_range_m;
  spec.dark_is_invalid = sensor.lost_is == Lost::invalid;
  spec.near_is_farther = sensor.near_is == Near::farther;
  spec.corner_scatter = sensor.corner_scatter_m;
}

}  // namespace

double radians(Angle angle) { return angle.wrapped() * (kPi / 2147483648.0); }

sim::NoiseSpec noise_spec(const Noise& n) {
  constexpr double kSqrtHour = 60;  // s^0.5
  sim::NoiseSpec spec;
  spec.range_sigma_m = n.range_sigma_m;
  spec.range_dropout = n.range_dropout;
  spec.range_false_clear = n.range_false_clear;
  spec.wheel_scale_sigma = n.wheel_scale_sigma;
  spec.heading_drift_rad_per_sqrt_m = n.heading_drift_deg_per_sqrt_m * kDegree;
  spec.wheel_scale_common_sigma = n.wheel_scale_common_sigma;
  spec.wheel_slip = n.wheel_slip;
  spec.gyro_bias_radps = n.gyro_bias_dps * kDegree;
  spec.gyro_warm_up_radps = n.gyro_warm_up_dps * kDegree;
  spec.gyro_walk_rad_per_sqrt_s = n.gyro_walk_deg_per_sqrt_h * kDegree / kSqrtHour;
  spec.gyro_scale_sigma = n.gyro_scale_sigma;
  spec.fix_every_m = n.fix_every_m;
  spec.fix_sigma_m = n.fix_sigma_m;
  spec.fix_sigma_rad = n.fix_sigma_deg * kDegree;
  return spec;
}

sim::RobotSpec robot_spec(const Scenario& scenario) {
  const Sensor& sensor = scenario.sensor;
  sim::RobotSpec spec = sim::robot_spec(scenario.robot);
  spec.motor_lag *= 1 - scenario.noise.motor_lag_shorter;
  if (sensor.incidence_deg < 90) spec.incidence = sensor.incidence_deg * kDegree;
  set_width(sensor, spec);
  set_reach(sensor, spec);
  spec.range_scale = sensor.scale;
  spec.phantom = sensor.phantom;
  spec.crosstalk = sensor.crosstalk;
  spec.range_sigma = sensor.sigma_m;
  spec.range_sigma_share = sensor.sigma_share;
  spec.cover_glass = sensor.cover_glass_probability;
  spec.cover_glass_at = sensor.cover_glass_m;
  return spec;
}

Pose fixed_pose(const sim::Pose& pose) {
  const double turns = pose.heading / (2 * kPi);
  const double fraction = turns - std::floor(turns);
  const std::uint64_t raw = static_cast<std::uint64_t>(std::floor(fraction * 4294967296.0 + 0.5));
  return {{length(pose.at.x), length(pose.at.y)}, Angle::from_raw(static_cast<std::uint32_t>(raw))};
}

Pose pose_of(const Event& event, const sim::Pose& truth) {
  sim::Pose pose = truth;
  if (event.x_m) pose.at.x = *event.x_m;
  if (event.y_m) pose.at.y = *event.y_m;
  if (event.heading_deg) pose.heading = *event.heading_deg * kDegree;
  return fixed_pose(pose);
}

localization::PoseSigma fixed_sigma(double sigma_m, double sigma_rad) {
  const Pose sigma = fixed_pose({{sigma_m, 0}, sigma_rad});
  return {sigma.at.x, sigma.at.x, sigma.heading};
}

localization::UncertainPose fix_of(const Event& event, const sim::Pose& truth) {
  return {pose_of(event, truth), fixed_sigma(event.sigma_m, event.sigma_deg * kDegree)};
}

}  // namespace whisker
