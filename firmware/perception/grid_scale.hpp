/// Lengths as grid units: 256 per cell.
#pragma once

#include <stdint.h>

#include "firmware/math/units.hpp"
#include "firmware/perception/raster.hpp"

namespace whisker::perception {

/// Grid units of short lengths by products of 16 bits, for chips that divide slowly.
class UnitsByProduct {
 public:
  static constexpr int32_t kNear = INT32_C(1) << 22;
  /// Cells smaller than kSmallest are divided by.
  static constexpr int32_t kSmallest = 8192;
  explicit UnitsByProduct(int32_t cell_um) noexcept {
    if (cell_um >= kSmallest) configure(cell_um);
  }
  /// um * 256 / cell_um, rounded down, and what is left. 0 <= um <= kNear; cell_um: the constructor's.
  int32_t whole(int32_t um, int32_t cell_um, int32_t& rest) const noexcept;

 private:
  void configure(int32_t cell_um) noexcept;
  static constexpr int kCoarse = 6;  // bits of um that a factor of 16 bits leaves out: less than 3 units
  uint16_t per_um_ = 0;              // units per um, 2^-(places_ + kCoarse), too few by less than 2^-15
  uint8_t places_ = 0;               // none: divide
};

class GridScale {
 public:
  /// cell_um: side of a cell; > 0 before any other question.
  explicit GridScale(int32_t cell_um = 0) noexcept
      : cell_um_(cell_um), by_product_(kDividesSlowly ? cell_um : 0) {}
  int32_t cell_um() const noexcept { return cell_um_; }

  /// Rounded down, at most kLongest. l >= 0.
  int32_t units(Length l) const noexcept;
  /// Of a coordinate, from the corner of the cell with this number; rounded down, within
  /// -kOutermost..kOutermost.
  int32_t units_from(int32_t corner, Length x) const noexcept;

 private:
  int32_t far_units(int64_t um, int32_t most) const noexcept;

  int32_t cell_um_;
  UnitsByProduct by_product_;
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
