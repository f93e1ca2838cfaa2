/// How far ahead sensors that lose walls at an angle give warning, and the speed that goes with it.
#pragma once

#include "firmware/math/units.hpp"
#include "firmware/params.hpp"

namespace whisker::safety {

/// The shortest way from the first echo of an obstacle to its rim, if clear ground may hold it.
///
/// A disc as large as the body touches its flank. The outermost ray, at the angle A + cone / 2, gives an echo
/// once it meets the disc at the incidence L: radius x sin(L) / sin(A + cone / 2) before the contact on a
/// straight course. Two thirds of that is the shortest warning, because a smaller or a curved obstacle leaves
/// less.
Length shortest_warning(const Params& params) noexcept;

/// From an echo until the body brakes. `readings_err`: see Perception::readings_err().
Duration warning_delay(const Params& params, bool readings_err) noexcept;

/// From this speed, the body stops within the shortest warning, from the first echo on.
Speed warned_speed(const Params& params, bool readings_err) noexcept;

/// The same while the rims turn at this speed: what the inner flank runs into comes into view later. At least
/// a quarter of the speed straight ahead.
constexpr Speed warned_speed(Speed straight, Speed turning) noexcept {
  const Speed rest = turning < Speed{} ? straight + turning : straight - turning;
  return rest < straight / 4 ? straight / 4 : rest;
}

}  // namespace whisker::safety
