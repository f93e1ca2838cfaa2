#pragma once

#include "firmware/core/trig.hpp"
#include "firmware/core/units.hpp"

namespace whisker::nav {

/// The distance of a point from the straight way from the origin to (step, 0).
inline Length gap_from_way(Vec point, Length step) noexcept {
  if (point.x < Length{}) return norm(point);
  if (point.x <= step) return abs(point.y);
  return norm({point.x - step, point.y});
}

}  // namespace whisker::nav
