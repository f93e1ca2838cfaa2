#pragma once

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"

namespace whisker::planning {

/// True if a point lies nearer than `reach` to the straight way from the origin to (step, 0). By squares: a
/// root would take the small chips longer than all the rest.
inline bool near_way(Vec point, Length step, Length reach) noexcept {
  const Length beside = point.x < Length{} ? point.x : (max)(point.x - step, Length{});
  const int64_t x = beside.raw();
  const int64_t y = point.y.raw();
  const int64_t r = reach.raw();
  return x * x + y * y < r * r;
}

}  // namespace whisker::planning
