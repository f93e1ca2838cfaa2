/// Random positions and shapes for properties. rapidcheck prints its seed; RC_PARAMS repeats it.
#pragma once

#include <rapidcheck.h>

#include "host/harness/sim/geometry.hpp"

namespace whisker::sim {

/// A multiple of a micro-unit in [low, high).
inline double real(double low, double high) {
  return 1e-6 * *rc::gen::inRange<int>(static_cast<int>(low * 1e6), static_cast<int>(high * 1e6));
}

inline Vec2 point(double reach) {
  const double x = real(-reach, reach);
  const double y = real(-reach, reach);
  return {x, y};
}

}  // namespace whisker::sim
