/// Speed and turn rate for a wanted heading.
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

/// The turn rate up to which the readings follow.
constexpr AngularRate kFastestTurn = 2500_mrad_per_s;

/// The smallest heading error that the body can hold: `wanted`, or slightly more than the turn of one encoder
/// count if that is larger. A smaller tolerance could make it oscillate.
Angle nearest_facing(Angle wanted, const Params& params) noexcept;

/// gain x error, at most kFastestTurn.
AngularRate rate_towards(Angle error, int32_t gain) noexcept;

/// The highest speed that stops within `rest` if braking begins after `delay`: v with v^2 / 2a + v * delay =
/// rest.
Speed stopping_speed(Length rest, Duration delay, const Params& params) noexcept;

/// The same with the settling time as the delay.
Speed approach_speed(Length rest, const Params& params) noexcept;

/// A cruise at this twist.
Manoeuvre cruise(Twist twist, const Params& params) noexcept;

/// Drives while turning: at `top` straight ahead, slower for larger heading errors, and not at all beyond 1 /
/// 1.2 rad. Turns hardly faster than the wheels can stop within the error.
Manoeuvre steer(Angle error, Speed top, const Params& params) noexcept;

/// Turns on the spot by the error, never faster than the wheels can stop within it.
Manoeuvre face(Angle error, const Params& params) noexcept;

/// Turns on the spot by the error. True when the error is below 3 degrees, see nearest_facing.
bool turn_by(Angle error, const Params& params, Manoeuvre& manoeuvre) noexcept;

}  // namespace whisker::planning
