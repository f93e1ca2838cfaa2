#include "firmware/localization/wall_fit.hpp"

namespace whisker::localization {
namespace {

constexpr int kShift = 8;  // um to 2^8 um, so that squares of 4 m fit into 32 bits

/// um, of the mean of squares of 2^8 um.
Length root(int64_t mean) noexcept {
  const uint64_t square = mean <= 0 ? 0 : static_cast<uint64_t>(mean) << (2 * kShift);
  return Length::from_raw(as_signed(square_root(square)));
}

}  // namespace

WallLine wall_line(const Vec* points, int count) noexcept {
  int64_t x = 0;
  int64_t y = 0;
  for (int i = 0; i < count; ++i) {
    x += (points[i].x - points[0].x).raw();
    y += (points[i].y - points[0].y).raw();
  }
  const Vec middle = points[0] + Vec{Length::from_raw(saturate32(divide_rounded(x, count))),
                                     Length::from_raw(saturate32(divide_rounded(y, count)))};
  int64_t xx = 0;
  int64_t xy = 0;
  int64_t yy = 0;
  for (int i = 0; i < count; ++i) {
    const Vec from = points[i] - middle;
    const int64_t dx = scale_down<kShift>(from.x.raw());
    const int64_t dy = scale_down<kShift>(from.y.raw());
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  const int32_t difference = saturate32(quotient(xx - yy, count));
  const int32_t mixed = saturate32(quotient(2 * xy, count));
  const int64_t sum = quotient(xx + yy, count);
  const int64_t axes = square_root(static_cast<uint64_t>(square(difference) + square(mixed)));
  const int32_t twice = atan2(mixed, difference).wrapped();
  return {Angle::from_raw(static_cast<uint32_t>(twice / 2)), root((sum - axes) / 2), root((sum + axes) / 2),
          middle};
}

}  // namespace whisker::localization
