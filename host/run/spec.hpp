/// The simulated robot's numbers, taken from the core's own parameters.
#pragma once

#include "firmware/core/trig.hpp"
#include "host/scenario/scenario.hpp"
#include "host/sim/plant.hpp"

namespace whisker {

sim::RobotSpec robot_spec(const Params& params);
sim::NoiseSpec noise_spec(const Noise& noise);
double radians(Angle angle);  ///< in [-pi, pi)

/// A pose rounded to the core's units.
Pose fixed_pose(const sim::Pose& pose);

}  // namespace whisker
