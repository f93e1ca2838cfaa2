/// Conversion between the units of the core and the simulator.
#pragma once

#include "firmware/math/trig.hpp"
#include "host/scenario/scenario.hpp"
#include "host/sim/spec.hpp"

namespace whisker {

sim::NoiseSpec noise_spec(const Noise& noise);
/// The simulated robot: the scenario's robot with the sensors that it really has.
sim::RobotSpec robot_spec(const Scenario& scenario);
double radians(Angle angle);  ///< in [-pi, pi)

/// A pose rounded to the core's units.
Pose fixed_pose(const sim::Pose& pose);

}  // namespace whisker
