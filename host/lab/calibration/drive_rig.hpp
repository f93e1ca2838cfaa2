/// A simulated robot whose wheels and gyro are not what its parameters say, and its calibration missions.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "firmware/calibration/values.hpp"
#include "firmware/planning/calibration/spin_planner.hpp"
#include "firmware/planning/calibration/square_planner.hpp"
#include "firmware/planning/calibration/straight_planner.hpp"
#include "firmware/robot.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/sim/plant.hpp"
#include "host/lab/calibration/umbmark.hpp"

namespace whisker::calibration {

/// True value / the one in the parameters.
struct WheelErrors {
  double gyro_scale = 1;
  double wheel_ratio = 1;
  double counts_per_m = 1;
  double track = 1;
};

/// Standard deviations of what is drawn, relative.
struct WheelErrorSigmas {
  double gyro_scale = 0.01;
  double wheel = 0.01;   ///< of each wheel: their ratio and half of their common scale
  double common = 0.01;  ///< of both wheels together
  double track = 0.01;
};
WheelErrors draw(const WheelErrorSigmas& sigmas, std::uint64_t seed);

/// The true values of a robot with these errors.
double true_value(const Params& believed, const WheelErrors& errors, Quantity quantity);

/// Where the spin takes place.
enum class Scene : std::uint8_t { discs, wall, room };
constexpr int kScenes = 3;
const char* name(Scene scene);
/// Random, by the seed; nothing is nearer than the body needs to turn.
Scenario scene(Scene scene, const Params& params, std::uint64_t seed);

/// Why a mission ended; empty: it has a result.
struct Ended {
  std::string trouble;
  double time_s = 0;
  bool good() const { return trouble.empty(); }
};

class DriveRig {
 public:
  /// The noise without what is drawn once a run: the errors say that.
  DriveRig(const Params& believed, const Sensor& sensor, const Noise& noise, const WheelErrors& errors,
           std::uint64_t seed);

  /// In this world, from its origin.
  Ended spin(const Scenario& world, planning::SpinPlanner& planner);
  /// The same; by default on free ground.
  Ended straight(planning::StraightPlanner& planner, const Scenario& world = {});
  /// The same; where the robot is at the end and where it believes to be. `end` knows the side.
  Ended square(planning::SquarePlanner& planner, SquareEnd& end, const Scenario& world = {});
  /// So many seconds after the start of each mission, the gyro falls silent.
  void gyro_dies(double after_s) { gyro_dies_s_ = after_s; }
  /// The true distance from the start of the last mission, along its first heading, m.
  double distance_m() const { return distance_m_; }

 private:
  using Told = std::function<planning::Trouble()>;
  Ended run(const Scenario& world, planning::Planner& planner, const Told& trouble, SquareEnd* end);

  Params believed_;
  Sensor sensor_;
  Noise noise_;
  WheelErrors errors_;
  std::uint64_t seed_;
  double gyro_dies_s_ = 1e9;
  double distance_m_ = 0;
};

}  // namespace whisker::calibration
