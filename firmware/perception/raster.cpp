#include "firmware/perception/raster.hpp"

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"

namespace whisker::perception {
namespace {

/// Chord of the disc around x in a row at distance dy from its centre.
Span chord(int32_t x, int32_t dy, int32_t radius) noexcept {
  if (radius < 0 || dy > radius || dy < -radius) return {INT16_MAX, -INT16_MAX};
  const int32_t half = narrow<int32_t>(square_root_32(narrow<uint32_t>(radius * radius - dy * dy)));
  return {x - half, x + half};
}

/// Span of the centres of the cells that this disc touches.
Span touch(int32_t x, int32_t dy, int32_t radius) noexcept {
  const int32_t off = absolute(dy) - kHalfSquare;
  const Span span = chord(x, off < 0 ? 0 : off, radius);
  return {span.low - kHalfSquare, span.high + kHalfSquare};
}

}  // namespace

int bits(Row row) noexcept {
  int n = 0;
  for (; row != 0; row &= row - 1) ++n;
  return n;
}

void Span::within_disc(int32_t x, int32_t dy, int32_t radius) noexcept {
  const Span inside = chord(x, dy, radius);
  cut_low(inside.low);
  cut_high(inside.high);
}

void Span::inside_disc(int32_t x, int32_t dy, int32_t radius) noexcept {
  const Span span = chord(x, absolute(dy) + kHalfSquare, radius);
  cut_low(span.low + kHalfSquare);
  cut_high(span.high - kHalfSquare);
}

void Span::touched_by_disc(int32_t x, int32_t dy, int32_t radius) noexcept {
  const Span span = touch(x, dy, radius);
  cut_low(span.low);
  cut_high(span.high);
}

Row Span::columns() const noexcept {
  constexpr int32_t kLastCentre = kCells * kUnitsPerCell - kHalfCell;
  if (low > kLastCentre || high < kHalfCell) return 0;
  const int32_t first = low < kHalfCell ? 0 : (low - kHalfCell + kUnitsPerCell - 1) / kUnitsPerCell;
  const int32_t last = high > kLastCentre ? kCells - 1 : (high - kHalfCell) / kUnitsPerCell;
  return columns_between(static_cast<int>(first), static_cast<int>(last));
}

Rows::Rows(int32_t low, int32_t high, int32_t reach) noexcept
    : row_(static_cast<int>(ceil_div(low - reach - kHalfCell, kUnitsPerCell))),
      last_(static_cast<int>(floor_div(high + reach - kHalfCell, kUnitsPerCell))) {
  if (row_ < 0) row_ = 0;
  if (last_ > kCells - 1) last_ = kCells - 1;
}

template <bool kSteps>
void CutBy<kSteps>::clip(Span& span, int32_t dy) const noexcept {
  const int32_t rest = margin_ - ny_ * dy;
  if (nx_ > 0) {
    span.cut_low(x_ + ceil_div(rest, nx_));
  } else if (nx_ < 0) {
    span.cut_high(x_ - ceil_div(rest, -nx_));
  } else if (rest > 0) {
    span.high = span.low - 1;
  }
}

CutBy<true>::CutBy(const HalfPlane& plane, int32_t x, int32_t dy, int32_t margin) noexcept
    : x_(x), nx_(plane.nx) {
  constexpr int32_t kOne = 1 << 14;
  const int32_t rest = margin * kOne - plane.ny * dy;
  const int32_t step = plane.ny * kUnitsPerCell;
  parts_ = nx_ == 0 ? 1 : absolute(nx_);
  inside_ = ceil_div(rest, parts_);
  over_ = inside_ * parts_ - rest;
  step_ = floor_div(step, parts_);
  step_parts_ = step - step_ * parts_;
}

void CutBy<true>::next() noexcept {
  inside_ -= step_;
  over_ += step_parts_;
  if (over_ < parts_) return;
  over_ -= parts_;
  --inside_;
}

void CutBy<true>::clip(Span& span, int32_t) const noexcept {
  if (nx_ > 0) {
    span.cut_low(x_ + inside_);
  } else if (nx_ < 0) {
    span.cut_high(x_ - inside_);
  } else if (inside_ > 0) {
    span.high = span.low - 1;
  }
}

template class CutBy<false>;

void WedgeCut::clip(Span& span, int32_t dy) const noexcept {
  left.clip(span, dy);
  right.clip(span, dy);
}

void HalfPlane::clip(Span& span, int32_t x, int32_t dy, int32_t margin) const noexcept {
  if (kDividesSlowly) {
    const int32_t rest = margin * (1 << 14) - ny * dy;
    // Most rows lie completely inside or outside, which shows without a division.
    const bool low_inside = (span.low - x) * nx >= rest;
    const bool high_inside = (span.high - x) * nx >= rest;
    if (low_inside && high_inside) return;
    if (!low_inside && !high_inside) {
      span.high = span.low - 1;
      return;
    }
  }
  CutBy<false>(*this, x, 0, margin).clip(span, dy);
}

int32_t HalfPlane::corner() const noexcept {
  return ceil_div((absolute(nx) + absolute(ny)) * kHalfCell, 1 << 14) + kRim;
}

void HalfPlane::hold(Span& span, int32_t x, int32_t dy) const noexcept { clip(span, x, dy, corner()); }

HalfPlane HalfPlane::ahead_of(Facing direction) noexcept { return {q14(direction.cos), q14(direction.sin)}; }

HalfPlane HalfPlane::left_of(Facing direction) noexcept { return {-q14(direction.sin), q14(direction.cos)}; }

HalfPlane HalfPlane::facing(const Vec& way, Length length) noexcept {
  const auto part = [&](Length x) { return multiply_divide(x.raw(), 1 << 14, length.raw()); };
  return {part(way.x), part(way.y)};
}

Wedge::Wedge(Angle axis, Angle half) noexcept
    : left_{q14(sin(axis + half)), -q14(cos(axis + half))},
      right_{-q14(sin(axis - half)), q14(cos(axis - half))},
      left_corner_(left_.corner()),
      right_corner_(right_.corner()) {}

Wedge::Extent Wedge::extent(int32_t radius) const noexcept {
  // At this radius the edges are the highest and lowest points, unless the wedge contains the vertical.
  const int32_t left = scale_down<14>(left_.nx * radius);
  const int32_t right = scale_down<14>(-right_.nx * radius);
  const int32_t higher = left > right ? left : right;
  const int32_t lower = left > right ? right : left;
  const bool up = left_.ny >= 0 && right_.ny >= 0;
  const bool down = left_.ny <= 0 && right_.ny <= 0;
  return {down ? -radius : lower < 0 ? lower : 0, up ? radius : higher > 0 ? higher : 0};
}

int32_t Wedge::outside(int32_t margin) const noexcept {
  // The sum of both normals is twice the sine of half the cone long.
  const int32_t x = absolute(left_.nx + right_.nx);
  const int32_t y = absolute(left_.ny + right_.ny);
  const int32_t longer = x > y ? x : y;
  return longer == 0 ? kLongest : kRim + margin * (1 << 15) / longer;
}

Rows Wedge::rows(int32_t y, int32_t radius) const noexcept {
  const Extent e = extent(radius);
  return Rows(y + e.low, y + e.high, kRim);
}

void Wedge::hold(Span& span, int32_t x, int32_t dy) const noexcept {
  left_.clip(span, x, dy, left_corner_);
  right_.clip(span, x, dy, right_corner_);
}

void Wedge::clip(Span& span, int32_t x, int32_t dy, int32_t margin) const noexcept {
  left_.clip(span, x, dy, margin);
  right_.clip(span, x, dy, margin);
}

Rows EchoArc::rows(int32_t y) const noexcept {
  const Wedge::Extent e = cone.extent(ends);
  const int32_t off = cone.outside(kCellCover);
  return Rows(y + e.low, y + e.high, off < ends ? off : ends);
}

WedgeCut EchoArc::edges(int32_t x, int32_t dy) const noexcept { return cone.clipping(x, dy, -kCellCover); }

Row EchoArc::columns(int32_t x, int32_t dy) const noexcept { return columns(edges(x, dy), x, dy); }

Row EchoArc::columns(const WedgeCut& edges, int32_t x, int32_t dy) const noexcept {
  Span touched = Span::around(x, ends);
  edges.clip(touched, dy);
  if (touched.empty()) return 0;
  touched.within_disc(x, dy, ends);
  Span nearer = Span::around(x, ends);
  nearer.inside_disc(x, dy, begins);
  return touched.columns() & ~nearer.columns();
}

Stadium::Stadium(const Sweep& sweep) noexcept
    : x_(sweep.x),
      y_(sweep.y),
      length_(sweep.length < kLongest ? sweep.length : kLongest),
      radius_(sweep.radius),
      abeam_(sweep.abeam),
      ux_(q14(cos(sweep.heading))),
      uy_(q14(sin(sweep.heading))) {
  beside_ = radius_ + HalfPlane{ux_, uy_}.corner();
  const int32_t skew = (ux_ < 0 ? -uy_ : uy_) - (uy_ < 0 ? -ux_ : ux_);
  skew_ = scale_down<14>(skew * kHalfCell);
  end_x_ = scale_down<14>(ux_ * length_);
  end_y_ = scale_down<14>(uy_ * length_);
  aside_x_ = -scale_down<14>(uy_ * beside_);
  aside_y_ = scale_down<14>(ux_ * beside_);
}

Rows Stadium::rows() const noexcept {
  const int32_t reach = radius_ + kHalfSquare;
  return end_y_ < 0 ? Rows(y_ + end_y_, y_, reach) : Rows(y_, y_ + end_y_, reach);
}

Row Stadium::box() const noexcept {
  const int32_t reach = radius_ + kUnitsPerCell;
  return end_x_ < 0 ? Span{x_ + end_x_ - reach, x_ + reach}.columns()
                    : Span{x_ - reach, x_ + end_x_ + reach}.columns();
}

/// Adds what the discs at both ends touch.
void Stadium::ends(Span& span, int32_t dy) const noexcept {
  const int32_t reach = radius_ + kHalfSquare;
  if (absolute(dy) <= reach) span.add(touch(x_, dy, radius_));
  if (absolute(dy - end_y_) <= reach) span.add(touch(x_ + end_x_, dy - end_y_, radius_));
}

/// Adds where the row crosses this long edge. False: it does not.
bool Stadium::side(Span& span, int32_t dy, int32_t sign) const noexcept {
  const int32_t from_y = dy - sign * aside_y_;
  const int32_t half = uy_ / 2;
  const int32_t t = (from_y * (1 << 14) + ((from_y < 0) == (uy_ < 0) ? half : -half)) / uy_;
  if (t < sign * skew_ || t > length_ + sign * skew_) return false;
  const int32_t x = x_ + sign * aside_x_ + scale_down<14>(ux_ * t);
  span.add({x, x});
  return true;
}

Row Stadium::columns(int row) const noexcept {
  const int32_t dy = row * kUnitsPerCell + kHalfCell - y_;
  Span span{INT16_MAX, -INT16_MAX};
  const int crossed = uy_ == 0 ? 0 : side(span, dy, 1) + side(span, dy, -1);
  // Between the long edges, the discs add nothing.
  if (crossed < 2) ends(span, dy);
  if (span.empty()) return 0;
  HalfPlane{ux_, uy_}.clip(span, x_, dy, abeam_);
  return span.empty() ? 0 : span.columns();
}

}  // namespace whisker::perception
