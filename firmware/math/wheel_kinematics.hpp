/// From a twist to two wheels, within what the wheels can do.
#pragma once

#include "firmware/math/units.hpp"

namespace whisker {

struct WheelPair {
  Speed left;
  Speed right;
};

/// What the wheels do: as commanded last, and as they turn by now behind their motors' lag.
struct WheelState {
  WheelPair commanded;
  WheelPair rolling;
};

/// Wheel speeds for a forward speed and a rim speed of turning (counter-clockwise positive). Where a
/// wheel would pass `max`, both shrink in proportion: the path keeps its curvature and only the pace drops.
WheelPair inverse_kinematics(Speed forward, Speed turning, Speed max) noexcept;

/// One control tick from `now` towards `want`: both wheels cover the same fraction of their way, and
/// none changes by more than `max_change`, so that the curvature passes smoothly from one to the other.
WheelPair slew(const WheelPair& now, const WheelPair& want, Speed max_change) noexcept;

}  // namespace whisker
