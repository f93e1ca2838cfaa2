/// How far ahead sensors that lose walls at an angle give warning, and the speed that goes with it.
#pragma once

#include "firmware/math/units.hpp"
#include "firmware/params.hpp"

namespace whisker::safety {

/// From an echo until the body brakes. `readings_err`: see Perception::readings_err().
Duration warning_delay(const Params& params, bool readings_err) noexcept;

/// From this speed, the body stops within shortest_warning(), from the first echo on.
Speed warned_speed(const Params& params, bool readings_err) noexcept;

/// The same while the rims turn at this speed: what the inner flank runs into comes into view later. At least
/// a quarter of the speed straight ahead.
constexpr Speed warned_speed(Speed straight, Speed turning) noexcept {
  const Speed rest = turning < Speed{} ? straight + turning : straight - turning;
  return rest < straight / 4 ? straight / 4 : rest;
}

}  // namespace whisker::safety
