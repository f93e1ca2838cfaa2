/// The bump switches of the body.
#pragma once

#include <stdint.h>

#include "host/harness/sim/geometry.hpp"
#include "host/harness/sim/world.hpp"

namespace whisker::sim {

constexpr double kReleaseGap = 1e-3;  // m: a pressed switch opens when the gap is larger

/// The switch that a body with this pose presses, as hal::BumperReading::pressed, if an obstacle that does
/// not move is within `reach`, m, of its rim: the front one within 30 degrees of straight ahead, the left and
/// the right one from there to 90 degrees. 0: there is none, or it is behind.
uint8_t switch_pressed(const WorldView& world, const Pose& body, double body_radius, double reach);

}  // namespace whisker::sim
