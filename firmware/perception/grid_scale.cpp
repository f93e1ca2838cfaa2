#include "firmware/perception/grid_scale.hpp"

namespace whisker::perception {
namespace {

constexpr int64_t kNear = INT32_C(1) << 30;

constexpr int32_t within(int64_t x, int32_t limit) noexcept {
  return narrow<int32_t>(x > limit ? limit : x < -limit ? -limit : x);
}

}  // namespace

int32_t GridScale::units(int64_t um, int32_t most) const noexcept {
  const int64_t n = um * kUnitsPerCell;
  // Most values are small, and a 32-bit division is faster.
  if (n < kNear && n > -kNear) return within(floor_div(narrow<int32_t>(n), cell_um), most);
  return within(floor_div(n, cell_um), most);
}

int32_t GridScale::units(Length l) const noexcept {
  const int32_t um = l.raw();
  if (um < 0 || um > INT32_MAX / kUnitsPerCell) return units(um, kLongest);
  const int32_t whole = um * kUnitsPerCell / cell_um;
  return whole > kLongest ? kLongest : whole;
}

}  // namespace whisker::perception
