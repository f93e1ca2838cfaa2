#include "firmware/ground/raster.hpp"

#include "firmware/core/trig.hpp"

namespace whisker::ground {
namespace {

int32_t q14(Q30 x) noexcept { return static_cast<int32_t>(scale_down<16>(int64_t{x.raw()})); }

/// Of the disc around x in a row that lies dy from its centre.
Span chord(int32_t x, int32_t dy, int32_t radius) noexcept {
  if (radius < 0 || dy > radius || dy < -radius) return {INT16_MAX, -INT16_MAX};
  const int32_t half = root(static_cast<uint32_t>(radius * radius - dy * dy));
  return {x - half, x + half};
}

}  // namespace

int bits(Row row) noexcept {
  int n = 0;
  for (; row != 0; row &= row - 1) ++n;
  return n;
}

int lowest(Row row) noexcept {
  int n = 0;
  for (; (row & 1U) == 0; row >>= 1) ++n;
  return n;
}

int32_t root(uint32_t x) noexcept {
  uint32_t r = 0;
  for (uint32_t bit = UINT32_C(1) << 30; bit != 0; bit >>= 2) {
    if (x >= r + bit) {
      x -= r + bit;
      r = (r >> 1) + bit;
    } else {
      r >>= 1;
    }
  }
  return static_cast<int32_t>(r);
}

void Span::within_disc(int32_t x, int32_t dy, int32_t radius) noexcept {
  const Span inside = chord(x, dy, radius);
  cut_low(inside.low);
  cut_high(inside.high);
}

Row Span::columns() const noexcept {
  int first = static_cast<int>(ceil_div(low - kHalfCell, kUnitsPerCell));
  int last = static_cast<int>(floor_div(high - kHalfCell, kUnitsPerCell));
  if (first < 0) first = 0;
  if (last > kCells - 1) last = kCells - 1;
  return ground::columns(first, last);
}

Rows::Rows(int32_t low, int32_t high, int32_t reach) noexcept
    : row_(static_cast<int>(ceil_div(low - reach - kHalfCell, kUnitsPerCell))),
      last_(static_cast<int>(floor_div(high + reach - kHalfCell, kUnitsPerCell))) {
  if (row_ < 0) row_ = 0;
  if (last_ > kCells - 1) last_ = kCells - 1;
}

void HalfPlane::clip(Span& span, int32_t x, int32_t dy, int32_t margin) const noexcept {
  constexpr int32_t kOne = 1 << 14;
  const int32_t rest = margin * kOne - ny * dy;
  if (nx > 0) {
    span.cut_low(x + ceil_div(rest, nx));
  } else if (nx < 0) {
    span.cut_high(x - ceil_div(rest, -nx));
  } else if (rest > 0) {
    span.high = span.low - 1;
  }
}

HalfPlane HalfPlane::facing(Angle direction) noexcept { return {q14(cos(direction)), q14(sin(direction))}; }

Wedge::Wedge(Angle axis, Angle half) noexcept
    : left_{q14(sin(axis + half)), -q14(cos(axis + half))},
      right_{-q14(sin(axis - half)), q14(cos(axis - half))} {}

void Wedge::clip(Span& span, int32_t x, int32_t dy, int32_t margin) const noexcept {
  left_.clip(span, x, dy, margin);
  right_.clip(span, x, dy, margin);
}

Stadium::Stadium(const Sweep& sweep) noexcept
    : x_(sweep.x),
      y_(sweep.y),
      length_(sweep.length < kLongest ? sweep.length : kLongest),
      radius_(sweep.radius),
      abeam_(sweep.abeam),
      ux_(q14(cos(sweep.heading))),
      uy_(q14(sin(sweep.heading))) {
  end_x_ = scale_down<14>(ux_ * length_);
  end_y_ = scale_down<14>(uy_ * length_);
}

Rows Stadium::rows() const noexcept {
  return end_y_ < 0 ? Rows(y_ + end_y_, y_, radius_) : Rows(y_, y_ + end_y_, radius_);
}

void Stadium::side(Span& span, int32_t dy, int32_t sign) const noexcept {
  // Where the row crosses the way's long side, if it does.
  const int32_t from_y = dy - sign * scale_down<14>(ux_ * radius_);
  if (uy_ == 0) return;
  const int64_t t = divide_rounded(int64_t{from_y} * 16384, uy_ > 0 ? uy_ : -uy_) * (uy_ > 0 ? 1 : -1);
  if (t < 0 || t > length_) return;
  const int32_t x = x_ - sign * scale_down<14>(uy_ * radius_) + scale_down<14>(ux_ * static_cast<int32_t>(t));
  if (x < span.low) span.low = x;
  if (x > span.high) span.high = x;
}

Row Stadium::columns(int row) const noexcept {
  const int32_t dy = row * kUnitsPerCell + kHalfCell - y_;
  Span span = chord(x_, dy, radius_);
  const Span end = chord(x_ + end_x_, dy - end_y_, radius_);
  if (end.low < span.low) span.low = end.low;
  if (end.high > span.high) span.high = end.high;
  side(span, dy, 1);
  side(span, dy, -1);
  if (span.empty()) return 0;
  HalfPlane{ux_, uy_}.clip(span, x_, dy, abeam_);
  return span.empty() ? 0 : span.columns();
}

}  // namespace whisker::ground
