/// Lengths as grid units: 256 per cell.
#pragma once

#include <stdint.h>

#include "firmware/math/units.hpp"
#include "firmware/perception/raster.hpp"

namespace whisker::perception {

struct GridScale {
  int32_t cell_um;  ///< side of a cell

  /// Rounded down; within -most..most.
  int32_t units(int64_t um, int32_t most) const noexcept;
  int32_t units(Length l) const noexcept;
};

/// A point; grid units from the corner of the window.
struct GridPoint {
  int32_t x = 0;
  int32_t y = 0;
};

/// Within the range in which coordinates do not saturate.
constexpr bool nearby(GridPoint p) noexcept {
  return p.x > -kOutermost && p.x < kOutermost && p.y > -kOutermost && p.y < kOutermost;
}

}  // namespace whisker::perception
