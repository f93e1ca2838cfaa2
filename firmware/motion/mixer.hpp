/// From a twist to two wheels, within what the wheels can do.
#pragma once

#include "firmware/core/units.hpp"
#include "hal/wire.hpp"

namespace whisker::motion {

struct WheelPair {
  Speed left;
  Speed right;
};

/// Wheel speeds for a forward speed and a rim speed of turning (counter-clockwise positive). Where a
/// wheel would pass `max`, both shrink in proportion: the path keeps its curvature and only the pace drops.
WheelPair mix(Speed forward, Speed turning, Speed max) noexcept;

/// One control tick from `now` towards `want`: both wheels cover the same fraction of their way, and
/// none changes by more than `max_change`, so that the curvature passes smoothly from one to the other.
WheelPair slew(const WheelPair& now, const WheelPair& want, Speed max_change) noexcept;

/// To the wire's 0.1 mm/s, to nearest; saturates.
hal::WheelSpeeds to_wire(WheelPair speeds) noexcept;

}  // namespace whisker::motion
