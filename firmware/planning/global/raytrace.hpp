/// Straight lines over the cells of the map.
#pragma once

#include "firmware/planning/global/grid_map.hpp"

namespace whisker::planning {

/// Calls `visit(place)` for every cell that the line crosses after its first one, each a four-neighbour of
/// the previous one. Stops and returns false when `visit` returns false.
template <class Visit>
bool raytrace(const GridMap& map, Vec from, Vec to, Visit&& visit) noexcept {
  Cell p = map.place(from);
  const Cell end = map.place(to);
  const int64_t dx = int64_t{to.x.raw()} - from.x.raw();
  const int64_t dy = int64_t{to.y.raw()} - from.y.raw();
  const int32_t step_x = dx < 0 ? -1 : 1;
  const int32_t step_y = dy < 0 ? -1 : 1;
  while (p != end) {
    if (p.x == end.x) {
      p.y += step_y;
    } else if (p.y == end.y) {
      p.x += step_x;
    } else {
      // The line leaves the cell on the left or right of its far corner, and crosses the other side.
      const Vec middle = map.middle(p);
      const int64_t half = map.cell().raw() / 2;
      const int64_t cx = middle.x.raw() + step_x * half - from.x.raw();
      const int64_t cy = middle.y.raw() + step_y * half - from.y.raw();
      const int64_t side = (dx * cy - dy * cx) * step_x * step_y;
      if (side > 0) {
        p.x += step_x;
      } else {
        p.y += step_y;
      }
    }
    if (!visit(p)) return false;
  }
  return true;
}

}  // namespace whisker::planning
