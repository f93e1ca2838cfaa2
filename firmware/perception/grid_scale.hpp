/// Lengths as grid units: 256 per cell.
#pragma once

#include <stdint.h>

#include "firmware/math/units.hpp"
#include "firmware/perception/raster.hpp"

namespace whisker::perception {

struct GridScale {
  int32_t cell_um = 20000;  ///< side of a cell

  /// Rounded down; within -most..most.
  int32_t units(int64_t um, int32_t most) const noexcept;
  int32_t units(Length l) const noexcept;
  /// A coordinate of a point, from the corner of the window.
  int32_t coordinate(int64_t um) const noexcept;
};

/// A point; grid units from the corner of the window.
struct GridPoint {
  int32_t x = 0;
  int32_t y = 0;
  /// Within the range in which coordinates do not saturate.
  bool nearby() const noexcept {
    return x > -kOutermost && x < kOutermost && y > -kOutermost && y < kOutermost;
  }
};

}  // namespace whisker::perception
