/// Conversion between the units of the core and the simulator.
#pragma once

#include "firmware/localization/pose_fix.hpp"
#include "firmware/math/trig.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/sim/spec.hpp"

namespace whisker {

sim::NoiseSpec noise_spec(const Noise& noise);
/// The simulated robot: the scenario's robot with the sensors that it really has.
sim::RobotSpec robot_spec(const Scenario& scenario);
double radians(Angle angle);  ///< in [-pi, pi)

/// A pose rounded to the core's units.
Pose fixed_pose(const sim::Pose& pose);
/// Of an event: `truth` where it says nothing.
Pose pose_of(const Event& event, const sim::Pose& truth);
localization::UncertainPose fix_of(const Event& event, const sim::Pose& truth);
localization::PoseSigma fixed_sigma(double sigma_m, double sigma_rad);

}  // namespace whisker
