#pragma once

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"

namespace whisker::planning {

/// True if a point is nearer than `reach` to the straight path from the origin to (step, 0). Compares
/// squares, because a square root is expensive on small chips.
inline bool near_way(Vec point, Length step, Length reach) noexcept {
  const Length beside = point.x < Length{} ? point.x : (max)(point.x - step, Length{});
  const int64_t x = beside.raw();
  const int64_t y = point.y.raw();
  const int64_t r = reach.raw();
  return x * x + y * y < r * r;
}

}  // namespace whisker::planning
