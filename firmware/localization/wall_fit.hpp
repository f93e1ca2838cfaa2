/// A straight line through points.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"

namespace whisker::localization {

struct WallLine {
  Angle direction;  ///< modulo half a turn
  Length residual;  ///< root of the mean square of the points' distances from the line
  Length spread;    ///< the same of their distances from their middle, along the line
  Vec middle;
};

/// Total least squares. At least two points, each at most 4 m from the first one.
WallLine wall_line(const Vec* points, int count) noexcept;

}  // namespace whisker::localization
