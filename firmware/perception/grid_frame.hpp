/// Places in the world as grid units from the corner of a window of cells.
#pragma once

#include <stdint.h>

#include "firmware/math/units.hpp"
#include "firmware/math/vec.hpp"
#include "firmware/perception/raster.hpp"

namespace whisker::perception {

/// A point in a window; grid units from its corner.
struct GridPoint {
  int32_t x = 0;
  int32_t y = 0;
};

struct GridFrame {
  int32_t column = 0;  ///< of the window's corner, in world cells
  int32_t row = 0;
  int32_t cell_um = 20000;

  int32_t units(Length l) const noexcept;
  Length length_of(int32_t units) const noexcept;
  GridPoint local(Vec at) const noexcept;
  /// Within the range in which local() does not saturate.
  static bool nearby(GridPoint p) noexcept {
    return p.x > -kOutermost && p.x < kOutermost && p.y > -kOutermost && p.y < kOutermost;
  }

 private:
  int32_t units(int64_t um, int32_t most) const noexcept;
};

}  // namespace whisker::perception
