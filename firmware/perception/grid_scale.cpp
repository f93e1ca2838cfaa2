#include "firmware/perception/grid_scale.hpp"

namespace whisker::perception {
namespace {

template <class T>
constexpr int32_t within(T x, int32_t limit) noexcept {
  return x > limit ? limit : x < -limit ? -limit : static_cast<int32_t>(x);
}

}  // namespace

void UnitsByProduct::configure(int32_t cell_um) noexcept {
  const int bits = 32 - leading_zeros(static_cast<uint32_t>(cell_um));
  const uint64_t per_um = quotient(UINT64_C(1) << (bits + 15), static_cast<uint32_t>(cell_um));
  per_um_ = per_um > UINT16_MAX ? UINT16_MAX : static_cast<uint16_t>(per_um);
  places_ = static_cast<uint8_t>(bits + 15 - 8 - kCoarse);
}

int32_t UnitsByProduct::whole(int32_t um, int32_t cell_um, int32_t& rest) const noexcept {
  WHISKER_ASSERT(um >= 0 && um <= kNear);
  const int32_t n = um * kUnitsPerCell;
  auto found = places_ == 0
                   ? n / cell_um
                   : static_cast<int32_t>((static_cast<uint32_t>(um) >> kCoarse) * per_um_ >> places_);
  for (rest = n - found * cell_um; rest >= cell_um; rest -= cell_um) ++found;
  return found;
}

int32_t GridScale::far_units(int64_t um, int32_t most) const noexcept {
  return within(floor_div(um * kUnitsPerCell, cell_um_), most);
}

int32_t GridScale::units_from(int32_t corner, Length x) const noexcept {
  const int64_t off = int64_t{x.raw()} - signed_product(corner, cell_um_);
  if (off >= UnitsByProduct::kNear || off < -UnitsByProduct::kNear) return far_units(off, kOutermost);
  const auto um = static_cast<int32_t>(off);
  if (kDividesSlowly) {
    int32_t rest = 0;
    const int32_t size = by_product_.whole(um < 0 ? -um : um, cell_um_, rest);
    return within(um >= 0 ? size : rest == 0 ? -size : -size - 1, kOutermost);
  }
  const int32_t n = um * kUnitsPerCell;
  const int32_t whole = n / cell_um_;
  return within(whole * cell_um_ > n ? whole - 1 : whole, kOutermost);
}

int32_t GridScale::units(Length l) const noexcept {
  const int32_t um = l.raw();
  if (um < 0 || um >= UnitsByProduct::kNear) return far_units(um, kLongest);
  int32_t rest = 0;
  const int32_t whole =
      kDividesSlowly ? by_product_.whole(um, cell_um_, rest) : um * kUnitsPerCell / cell_um_;
  return whole > kLongest ? kLongest : whole;
}

}  // namespace whisker::perception
