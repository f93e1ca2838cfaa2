/// From a wanted heading to a speed and a turn rate.
#pragma once

#include "firmware/math/angle.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/planning/manoeuvre.hpp"

namespace whisker::planning {

struct Twist {
  Speed forward;
  AngularRate turning;  ///< counter-clockwise positive
};

/// The turn rate at which the readings still follow.
constexpr AngularRate kFastestTurn = 2500_mrad_per_s;

/// The smallest heading error that the body can hold: `wanted`, or a little more than the turn that one
/// encoder count makes, if that is larger. A body that tries to do better may swing for ever.
Angle nearest_facing(Angle wanted, const Params& params) noexcept;

/// gain x error, at most kFastestTurn.
AngularRate rate_towards(Angle error, int32_t gain) noexcept;

/// The highest speed from which `rest` is enough to stop: v with v^2 / 2a + v * settle = rest.
Speed approach_speed(Length rest, const Params& params) noexcept;

/// Drives while it turns: at `top` straight ahead, slower the more the heading is off, and not at all beyond
/// 1 / 1.2 rad.
Twist steer(Angle error, Speed top) noexcept;

/// A cruise at this twist.
Manoeuvre cruise(Twist twist, const Params& params) noexcept;

/// Turns by the error on the spot, never faster than the wheels can stop within it.
Manoeuvre face(Angle error, const Params& params) noexcept;

/// Turns by the error on the spot. True when it is below 3 degrees, see nearest_facing.
bool turn_by(Angle error, const Params& params, Manoeuvre& manoeuvre) noexcept;

}  // namespace whisker::planning
