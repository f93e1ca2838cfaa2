/// From the heading that is wanted to a speed and a turn rate.
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

/// `wanted`, or what the encoders can tell, if that is more: a little more than the turn that one count
/// makes, as both wheels may count at once. A body that tries to face anything more nearly may swing about it
/// for ever.
Angle nearest_facing(Angle wanted, const Params& params) noexcept;

/// gain x error, at most kFastestTurn.
AngularRate rate_towards(Angle error, int32_t gain) noexcept;

/// Turns by the error on the spot.
Twist face(Angle error) noexcept;

/// Drives while it turns: at `top` straight ahead, slower the more the heading is off, and not at all beyond
/// 1 / 1.2 rad.
Twist steer(Angle error, Speed top) noexcept;

/// A cruise at this twist.
Manoeuvre cruise(Twist twist, const Params& params) noexcept;

/// Faces what is off by the error. True within 3 degrees of it, see nearest_facing.
bool turn_by(Angle error, const Params& params, Manoeuvre& manoeuvre) noexcept;

}  // namespace whisker::planning
