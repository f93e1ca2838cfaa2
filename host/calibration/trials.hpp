/// How accurate the calibration is: many simulated spins of random robots, of which the truth is known.
#pragma once

#include <array>
#include <cstdint>

#include "host/calibration/calibration.hpp"
#include "host/calibration/simulated.hpp"

namespace whisker::calibration {

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
