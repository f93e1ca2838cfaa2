/// Contents of a scenario file in SI units. docs/scenario.md describes the file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/params.hpp"
#include "host/harness/scenario/event.hpp"
#include "host/harness/scenario/sensor.hpp"
#include "host/harness/sim/geometry.hpp"

namespace whisker {

struct Bounds {
  sim::Vec2 min;
  sim::Vec2 max;
};

/// A disc that moves along a polyline and back at constant speed.
struct Mover {
  sim::Vec2 center;  ///< its position at time 0; a point of the path
  double radius_m = 0;
  std::vector<sim::Vec2> path;
  double speed_mps = 0;
};

struct Noise {
  double range_sigma_m = 0;
  double range_dropout = 0;      ///< probability that a reading is lost
  double range_false_clear = 0;  ///< probability that a reading is wrongly clear
  double wheel_scale_sigma = 0;  ///< relative error of each wheel's encoder, drawn once per run
  double heading_drift_deg_per_sqrt_m = 0;
  double wheel_scale_common_sigma = 0;  ///< the same error of both encoders, drawn once per run
  double wheel_slip = 0;                ///< mean share of a wheel's travel that is lost while it speeds up
  double motor_lag_shorter = 0;         ///< share by which the wheels' lag is shorter than the robot believes
  double gyro_bias_dps = 0;             ///< standard deviation of the bias, drawn once per run
  double gyro_warm_up_dps = 0;          ///< of the change of the bias in the first 10 minutes
  double gyro_walk_deg_per_sqrt_h = 0;
  double gyro_scale_sigma = 0;  ///< relative error of the rate, drawn once per run
  double fix_every_m = 0;       ///< path between two fixes of the pose from outside; 0: none
  double fix_sigma_m = 0;       ///< standard deviation of each coordinate of a fix
  double fix_sigma_deg = 0;
};

struct Scenario {
  std::string name;
  std::uint64_t seed = 1;  ///< seed of the noise
  double time_limit_s = 600;
  sim::Pose start;  ///< heading towards the goal unless the file contains one
  Goal goal;
  std::optional<Bounds> bounds;  ///< a solid outer wall
  std::vector<sim::Disc> discs;
  std::vector<std::vector<sim::Vec2>> polygons;  ///< solid
  std::vector<std::vector<sim::Vec2>> walls;     ///< polylines of zero thickness
  std::vector<Mover> movers;
  Noise noise;
  Sensor sensor;
  Params robot;
  std::vector<Event> events;  ///< in the order of the file
};

}  // namespace whisker
