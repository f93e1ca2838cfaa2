/// The spin in front of a simulated wall.
#pragma once

#include <array>
#include <cstdint>

#include "host/harness/run/run_log.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/sim/spec.hpp"
#include "host/lab/calibration/calibration.hpp"
#include "host/lab/calibration/sample.hpp"

namespace whisker::calibration {

/// Faces a wall across its way, at this distance from the centre, m.
Scenario wall_scenario(const Params& params, const Sensor& sensor, const Noise& noise, double wall_m);

/// m: 0.3, more for a large body or sensors that are blind near by, less for sensors of a short range.
double usual_distance_m(const Params& params, const Sensor& sensor);

/// believed: of the odometry and the spin. what: the robot as it is. along_m: see Spin. Headings count from
/// the start. The spin ends early if the body touches the wall. log: null, or receives each tick.
Sweep simulated_spin(const Scenario& scenario, const Params& believed, const sim::RobotSpec& what,
                     std::uint64_t seed, double along_m = 0, RunLog* log = nullptr);

/// deg. What an ideal measurement at this distance would give.
struct Truth {
  double axis_deg = 0;
  double half_cone_deg = 0;
  double incidence_deg = 0;
  double edge_deg = 0;
};
Truth truth(const sim::RobotSpec& what, int beam, double wall_m);

/// A random robot in front of a wall: apexes anywhere on the body, cones 10 to 40 degrees wide, axes up to 8
/// degrees off, L of 25 to 75 degrees, wall 0.25 to 0.4 m away. The same for the same seed.
struct Trial {
  Scenario scenario;     ///< its robot is what the robot believes
  sim::RobotSpec robot;  ///< as it is
  double wall_m = 0;
  double along_m = 0;
  std::uint64_t seed = 0;
};
/// along_m: 0, or see Spin: then the body stands up to 5 degrees off square.
Trial random_trial(const Noise& noise, double phantom, double along_m, std::uint64_t seed);

struct TrialResult {
  Calibration measured;
  std::array<Truth, hal::kBeams> truth;
  double written_incidence_deg = 0;  ///< for the robot file; 0: none, because a beam was not measured
};
TrialResult run(const Trial& trial);

}  // namespace whisker::calibration
