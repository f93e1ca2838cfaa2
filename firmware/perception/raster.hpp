/// Rasterizes shapes on the rows of a grid window: columns whose centre is inside the shape, that lie
/// completely inside it, or that touch it.
///
/// Coordinates are grid units from the corner of the window (256 per cell).
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"

namespace whisker::perception {

/// One bit per cell.
using Row = uint32_t;

constexpr int kCells = 32;  ///< cells along a side of the window
constexpr int32_t kUnitsPerCell = 256;
constexpr int32_t kHalfCell = kUnitsPerCell / 2;
/// Rounding budget of points and normals; a cell is tested with a square that is larger by this on every
/// side.
constexpr int32_t kRim = 3;
constexpr int32_t kHalfSquare = kHalfCell + kRim;
/// The longest length of a shape: its square, and products with a normal, fit into 32 bits.
constexpr int32_t kLongest = 4 * kCells * kUnitsPerCell - 1;
/// Points lie at most this far from the corner of the window in x and in y.
constexpr int32_t kOutermost = 2 * kCells * kUnitsPerCell;

/// d > 0.
constexpr int32_t floor_div(int32_t n, int32_t d) noexcept {
  WHISKER_ASSERT(d > 0);
  return n >= 0 ? n / d : -((-n + d - 1) / d);
}
constexpr int64_t floor_div(int64_t n, int32_t d) noexcept {
  WHISKER_ASSERT(d > 0);
  return n >= 0 ? quotient(n, d) : -quotient(-n + d - 1, d);
}
[[gnu::always_inline]] constexpr int32_t ceil_div(int32_t n, int32_t d) noexcept {
  WHISKER_ASSERT(d > 0);
  return n > 0 ? (n + d - 1) / d : n / d;
}

/// The columns first..last of the window, both within 0..31.
constexpr Row columns_between(int first, int last) noexcept {
  WHISKER_ASSERT(first > last || (first >= 0 && last < kCells));
  return first > last ? 0U : (UINT32_MAX >> (kCells - 1 - (last - first))) << first;
}

int bits(Row row) noexcept;

/// An interval of x.
struct Span {
  int32_t low = -kUnitsPerCell;
  int32_t high = (kCells + 1) * kUnitsPerCell;

  /// Largest extent over the rows in which a disc touches cells.
  static Span around(int32_t x, int32_t radius) noexcept {
    return {x - radius - kHalfSquare, x + radius + kHalfSquare};
  }
  bool empty() const noexcept { return low > high; }
  /// Cells whose centres lie in this disc; cells completely inside it; cells that it touches.
  void within_disc(int32_t x, int32_t dy, int32_t radius) noexcept;
  void inside_disc(int32_t x, int32_t dy, int32_t radius) noexcept;
  void touched_by_disc(int32_t x, int32_t dy, int32_t radius) noexcept;
  /// Grows until it contains the other one.
  void add(const Span& other) noexcept {
    if (other.low < low) low = other.low;
    if (other.high > high) high = other.high;
  }
  void cut_low(int32_t x) noexcept {
    if (x > low) low = x;
  }
  void cut_high(int32_t x) noexcept {
    if (x < high) high = x;
  }
  Row columns() const noexcept;
};

/// The rows of the window whose centres lie within `reach` of y.
class Rows {
 public:
  Rows(int32_t y, int32_t reach) noexcept : Rows(y, y, reach) {}
  Rows(int32_t low, int32_t high, int32_t reach) noexcept;
  bool more() const noexcept { return row_ <= last_; }
  void next() noexcept { ++row_; }
  int row() const noexcept { return row_; }
  /// Offset of the row's centre from y.
  int32_t offset(int32_t y) const noexcept { return row_ * kUnitsPerCell + kHalfCell - y; }

 private:
  int row_;
  int last_;
};

/// A half plane nx x + ny y >= margin; the normal in 2^-14.
struct HalfPlane {
  /// The half plane ahead of a boundary that faces this direction.
  static HalfPlane ahead_of(Facing direction) noexcept;
  static HalfPlane facing(Angle direction) noexcept { return ahead_of(whisker::facing(direction)); }
  /// The same for a vector of this length > 0.
  static HalfPlane facing(const Vec& way, Length length) noexcept;
  /// The half plane to the left of a line in this direction.
  static HalfPlane left_of(Facing direction) noexcept;
  HalfPlane operator-() const noexcept { return {-nx, -ny}; }
  int32_t nx;
  int32_t ny;
  /// dy from the origin of the boundary, whose x is given.
  void clip(Span& span, int32_t x, int32_t dy, int32_t margin) const noexcept;
  /// Keeps the cells of the row that lie completely inside.
  void hold(Span& span, int32_t x, int32_t dy) const noexcept;
  /// The margin with which clip() keeps them.
  int32_t corner() const noexcept;
};

/// The boundary of a half plane, moved inwards by a margin, across the rows of a shape one after another:
/// clip() of a row, next(), clip() of the next row. kSteps: in steps from row to row, without a division.
template <bool kSteps>
class CutBy {
 public:
  /// As HalfPlane::clip(), with the dy of the first row.
  CutBy(const HalfPlane& plane, int32_t x, int32_t, int32_t margin) noexcept
      : nx_(plane.nx), ny_(plane.ny), x_(x), margin_(margin * (1 << 14)) {}
  /// dy is that of this row.
  void clip(Span& span, int32_t dy) const noexcept;
  void next() noexcept {}

 private:
  int32_t nx_, ny_;
  int32_t x_;
  int32_t margin_;
};
template <>
class CutBy<true> {
 public:
  CutBy(const HalfPlane& plane, int32_t x, int32_t dy, int32_t margin) noexcept;
  void clip(Span& span, int32_t) const noexcept;
  void next() noexcept;

 private:
  int32_t x_;
  int32_t nx_;      // only its sign
  int32_t inside_;  // of the boundary from x, towards the inside, rounded up
  int32_t over_;    // rounded up by so many parts
  int32_t parts_;   // of a unit
  int32_t step_;    // of a row
  int32_t step_parts_;
};
using Cut = CutBy<kDividesSlowly>;

/// Both edges of a wedge.
struct WedgeCut {
  Cut left;
  Cut right;
  void clip(Span& span, int32_t dy) const noexcept;
  void next() noexcept {
    left.next();
    right.next();
  }
};

/// The points between two directions. half < 90 degrees.
class Wedge {
 public:
  Wedge(Angle axis, Angle half) noexcept;
  /// The rows with points of the wedge at most this far from its apex.
  Rows rows(int32_t y, int32_t radius) const noexcept;
  /// The same points' least and largest y, from the apex.
  struct Extent {
    int32_t low;
    int32_t high;
  };
  Extent extent(int32_t radius) const noexcept;
  /// No point that is at most this margin outside both edges is farther than this from the wedge.
  int32_t outside(int32_t margin) const noexcept;
  /// Keeps the cells of the row that lie completely inside.
  void hold(Span& span, int32_t x, int32_t dy) const noexcept;
  /// Keeps the part of the row that is at least `margin` inside both edges.
  void clip(Span& span, int32_t x, int32_t dy, int32_t margin) const noexcept;
  /// The same for rows one after another from this one on.
  WedgeCut holding(int32_t x, int32_t dy) const noexcept {
    return {{left_, x, dy, left_corner_}, {right_, x, dy, right_corner_}};
  }
  WedgeCut clipping(int32_t x, int32_t dy, int32_t margin) const noexcept {
    return {{left_, x, dy, margin}, {right_, x, dy, margin}};
  }

 private:
  HalfPlane left_;
  HalfPlane right_;
  int32_t left_corner_;  // distance of a cell's corner from its centre across this edge
  int32_t right_corner_;
};

/// The cells from which an echo may come: those that a cone touches between two distances.
struct EchoArc {
  Wedge cone;
  int32_t begins;
  int32_t ends;
  /// The rows with cells of the arc, for an apex at y.
  Rows rows(int32_t y) const noexcept;
  /// The apex is at x, and dy from the row.
  Row columns(int32_t x, int32_t dy) const noexcept;
  /// For rows one after another from this one on.
  WedgeCut edges(int32_t x, int32_t dy) const noexcept;
  Row columns(const WedgeCut& edges, int32_t x, int32_t dy) const noexcept;
};

/// A straight path of a disc.
struct Sweep {
  int32_t x = 0;  ///< of its start
  int32_t y = 0;
  Angle heading;
  int32_t length = 0;
  int32_t radius = 0;
  int32_t abeam = 0;  ///< cells less than this ahead of the start are excluded
};

/// The cells that a disc touches on a straight path.
class Stadium {
 public:
  explicit Stadium(const Sweep& sweep) noexcept;
  Rows rows() const noexcept;
  Row columns(int row) const noexcept;
  /// The union of the columns over all rows.
  Row box() const noexcept;

 private:
  void ends(Span& span, int32_t dy) const noexcept;
  bool side(Span& span, int32_t dy, int32_t sign) const noexcept;
  int32_t x_, y_;
  int32_t end_x_, end_y_;  // from the start
  int32_t length_, radius_, abeam_;
  int32_t beside_;  // distance from the path to its edge: centres of cells that just touch it
  int32_t
      skew_;  // offset along the path at which that edge begins on the left; the negative offset on the right
  int32_t ux_, uy_;            // direction, 2^-14
  int32_t aside_x_, aside_y_;  // from the path to its left edge
};

}  // namespace whisker::perception
