/// Inverse kinematics: from a twist to two wheel speeds within the limits of the wheels.
#pragma once

#include "firmware/math/units.hpp"

namespace whisker {

struct WheelPair {
  Speed left;
  Speed right;
};

/// State of the wheels: the last command, what the acceleration limit lets them have of it by now, and the
/// estimated speed behind the motor lag.
struct WheelState {
  WheelPair commanded;
  WheelPair reached;
  WheelPair rolling;
};

/// Wheel speeds for a forward speed and a rim speed of turning (counter-clockwise positive). If a wheel would
/// exceed `max`, both scale down in proportion, so that the path keeps its curvature.
WheelPair inverse_kinematics(Speed forward, Speed turning, Speed max) noexcept;

/// One control tick from `now` towards `want`: both wheels change by the same fraction of their difference,
/// and neither by more than `max_change`, so that the curvature changes smoothly.
WheelPair slew(const WheelPair& now, const WheelPair& want, Speed max_change) noexcept;

}  // namespace whisker
