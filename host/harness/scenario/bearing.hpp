#pragma once

#include "host/harness/sim/geometry.hpp"

namespace whisker {

/// rad in one degree, to nearest.
constexpr double kRadPerDeg = 0.017453292519943295;

/// The heading from one point to another, rad in (-pi, pi]; 0 if they coincide.
/// The same bits on every machine: no libm but sqrt. Error below 1e-15 rad.
double bearing(sim::Vec2 from, sim::Vec2 to);

}  // namespace whisker
