#include "firmware/perception/grid_frame.hpp"

#include "firmware/math/fixed.hpp"

namespace whisker::perception {
namespace {

constexpr int64_t kNear = INT32_C(1) << 30;

constexpr int32_t within(int64_t x, int32_t limit) noexcept {
  return static_cast<int32_t>(x > limit ? limit : x < -limit ? -limit : x);
}

}  // namespace

int32_t GridFrame::units(int64_t um, int32_t most) const noexcept {
  const int64_t n = um * kUnitsPerCell;
  // Most values are small, and a 32-bit division is faster.
  if (n < kNear && n > -kNear) return within(floor_div(static_cast<int32_t>(n), cell_um), most);
  return within(floor_div<int64_t>(n, cell_um), most);
}

int32_t GridFrame::units(Length l) const noexcept { return units(l.raw(), kLongest); }

Length GridFrame::length_of(int32_t units) const noexcept {
  return Length::from_raw(multiply_divide(units, cell_um, kUnitsPerCell));
}

GridPoint GridFrame::local(Vec at) const noexcept {
  const auto from_corner = [this](Length x, int32_t corner) {
    return units(int64_t{x.raw()} - int64_t{corner} * cell_um, kOutermost);
  };
  return {from_corner(at.x, column), from_corner(at.y, row)};
}

}  // namespace whisker::perception
