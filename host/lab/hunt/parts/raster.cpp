// The shapes that are drawn on rows of the grid, against distances in double.
#include "firmware/perception/raster.hpp"

#include <algorithm>
#include <cmath>

#include "host/harness/run/spec.hpp"
#include "host/lab/hunt/parts/clutter.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

using namespace perception;

// The error of a normal of 14 bits over the longest distance, and the roundings to whole units.
constexpr double kUnits = 4;
const double kWithRim = kRim * std::sqrt(2.0) + 3;

double centre(int cell) { return cell * kUnitsPerCell + kHalfCell; }

std::int32_t draw_place(Dice& dice) {
  switch (dice.index(4)) {
    case 0: return dice.index(3) * kCells * kUnitsPerCell / 2;
    case 1: return dice.chance(0.5) ? -kOutermost : kOutermost;
    case 2: return dice.index(2 * kOutermost + 1) - kOutermost;
    default: return dice.index(kCells * kUnitsPerCell);
  }
}

std::int32_t draw_reach(Dice& dice) {
  switch (dice.index(5)) {
    case 0: return 0;
    case 1: return kLongest;
    case 2: return dice.index(kLongest);
    case 3: return -dice.index(1000);
    default: return dice.index(20 * kUnitsPerCell);
  }
}

/// True if each column that is inside by more than `surely` is in the row, and none that is outside by more
/// than `surely_not`.
template <class F>
bool fits(Row row, int line, const F& inside_by, double surely = kUnits, double surely_not = kUnits) {
  for (int column = 0; column < kCells; ++column) {
    const double by = inside_by(centre(column), centre(line));
    const bool in = (row >> column & 1U) != 0;
    if ((by > surely && !in) || (by < -surely_not && in)) return false;
  }
  return true;
}

Row columns_of(const Span& span) { return span.empty() ? 0 : span.columns(); }

struct Corners {
  double near_x, near_y, far_x, far_y;
  Corners(double cx, double cy, double x, double y)
      : near_x(std::max(std::fabs(cx - x) - kHalfCell, 0.0)),
        near_y(std::max(std::fabs(cy - y) - kHalfCell, 0.0)),
        far_x(std::fabs(cx - x) + kHalfCell),
        far_y(std::fabs(cy - y) + kHalfCell) {}
  double nearest() const { return std::hypot(near_x, near_y); }
  double farthest() const { return std::hypot(far_x, far_y); }
};

std::string judge_discs(Dice& dice) {
  const std::int32_t x = draw_place(dice), y = draw_place(dice), radius = draw_reach(dice);
  std::uint32_t visited = 0;
  for (Rows rows(y, radius); rows.more(); rows.next()) {
    if (rows.row() < 0 || rows.row() >= kCells) return "a row beyond the window";
    visited |= 1U << rows.row();
    Span span;
    span.within_disc(x, rows.offset(y), radius);
    const auto by = [&](double cx, double cy) { return radius - std::hypot(cx - x, cy - y); };
    if (!fits(span.columns(), rows.row(), by)) return "a disc has other cells";
  }
  for (int row = 0; row < kCells; ++row) {
    if ((visited >> row & 1U) != (std::fabs(centre(row) - y) <= radius ? 1U : 0U)) return "other rows";
    const auto dy = static_cast<std::int32_t>(centre(row)) - y;
    Span inside, touched;
    inside.inside_disc(x, dy, radius);
    const auto held = [&](double cx, double cy) { return radius - Corners(cx, cy, x, y).farthest(); };
    if (!fits(columns_of(inside), row, held, kWithRim, 0)) return "a disc holds other cells";
    if (radius < 0) continue;
    touched.touched_by_disc(x, dy, radius);
    const auto touches = [&](double cx, double cy) { return radius - Corners(cx, cy, x, y).nearest(); };
    if (!fits(columns_of(touched), row, touches, 0, kWithRim)) return "a disc touches other cells";
  }
  return "";
}

std::string judge_wedges(Dice& dice) {
  const std::int32_t x = draw_place(dice), y = draw_place(dice);
  const std::int32_t margin = dice.chance(0.3) ? draw_reach(dice) : dice.index(2000) - 1000;
  const Angle axis = draw_angle(dice), half = Angle::turns(1 + dice.index(449), 3600);
  const Wedge wedge(axis, half);
  const double a = radians(axis), h = radians(half);
  const auto inside_by = [&](double px, double py) {
    const double dx = px - x, dy = py - y;
    return std::min(dx * std::sin(a + h) - dy * std::cos(a + h),
                    -dx * std::sin(a - h) + dy * std::cos(a - h));
  };
  const auto held = [&](double cx, double cy) {
    double by = 1e9;
    for (const double sx : {-1.0, 1.0}) {
      for (const double sy : {-1.0, 1.0})
        by = std::min(by, inside_by(cx + sx * kHalfCell, cy + sy * kHalfCell));
    }
    return by;
  };
  const std::int32_t radius = std::abs(draw_reach(dice));
  std::uint32_t visited = 0;
  for (Rows rows = wedge.rows(y, radius); rows.more(); rows.next()) visited |= 1U << rows.row();
  for (int row = 0; row < kCells; ++row) {
    const auto dy = static_cast<std::int32_t>(centre(row)) - y;
    Span span, whole;
    wedge.clip(span, x, dy, margin);
    if (!fits(columns_of(span), row, [&](double cx, double cy) { return inside_by(cx, cy) - margin; })) {
      return "a wedge has other cells";
    }
    wedge.hold(whole, x, dy);
    if (!fits(columns_of(whole), row, held, kWithRim, 0)) return "a wedge holds other cells";
    const auto in_sector = [&](double cx, double cy) {
      return std::min(held(cx, cy), radius - Corners(cx, cy, x, y).farthest());
    };
    if ((visited >> row & 1U) == 0 && !fits(0, row, in_sector, 0, 0)) return "a row of a wedge is left out";
  }
  return "";
}

std::string judge_echo_arc(Dice& dice) {
  const std::int32_t x = dice.index(kCells * kUnitsPerCell), y = dice.index(kCells * kUnitsPerCell);
  const Angle axis = draw_angle(dice), half = Angle::turns(20 + dice.index(280), 3600);
  const std::int32_t begins = dice.index(15 * kUnitsPerCell), ends = begins + dice.index(4 * kUnitsPerCell);
  const EchoArc arc{Wedge(axis, half), begins, ends};
  const double a = radians(axis), h = radians(half);
  for (int row = 0; row < kCells; ++row) {
    const Row cells = arc.columns(x, static_cast<std::int32_t>(centre(row)) - y);
    for (int column = 0; column < kCells; ++column) {
      const double dx = centre(column) - x, dy = centre(row) - y, far = std::hypot(dx, dy);
      const double left = dx * std::sin(a + h) - dy * std::cos(a + h);
      const double inside_by = std::min(left, -dx * std::sin(a - h) + dy * std::cos(a - h));
      const bool on_it = far > begins + 2 && far < ends - 2 && inside_by > kUnits;
      const bool off_it = far < begins - 200 || far > ends + kUnits || inside_by < -200;
      const bool in = (cells >> column & 1U) != 0;
      if (on_it && !in) return "an echo does not come from its arc";
      if (off_it && in) return "an echo comes from beside its arc";
    }
  }
  return "";
}

std::string judge_stadium(Dice& dice) {
  const std::int32_t x = draw_place(dice), y = draw_place(dice), length = std::abs(draw_reach(dice));
  const std::int32_t radius = kUnitsPerCell + std::abs(draw_reach(dice)) / 4, abeam = dice.index(200);
  const Angle heading = draw_angle(dice);
  const Stadium stadium({x, y, heading, length, radius, abeam});
  const double ux = std::cos(radians(heading)), uy = std::sin(radians(heading));
  const auto from_path = [&](double px, double py) {
    const double on = std::clamp((px - x) * ux + (py - y) * uy, 0.0, static_cast<double>(length));
    return std::hypot(px - x - on * ux, py - y - on * uy);
  };
  // The path and the cell are apart by the distance of an end of one from the other.
  const auto inside_by = [&](double cx, double cy) {
    double apart = std::min(Corners(cx, cy, x, y).nearest(),
                            Corners(cx, cy, x + length * ux, y + length * uy).nearest());
    for (const double sx : {-1.0, 1.0}) {
      for (const double sy : {-1.0, 1.0})
        apart = std::min(apart, from_path(cx + sx * kHalfCell, cy + sy * kHalfCell));
    }
    return std::min(radius - apart, (cx - x) * ux + (cy - y) * uy - abeam);
  };
  // Nearly along an axis, the division by the slope may leave out a row that the path just enters.
  const double slope = std::min(std::fabs(ux), std::fabs(uy)),
               surely = slope > 1e-4 && slope < 0.1 ? 120 : 2 * kUnits;
  std::uint32_t visited = 0;
  Row all = 0;
  for (Rows rows = stadium.rows(); rows.more(); rows.next()) {
    visited |= 1U << rows.row();
    all |= stadium.columns(rows.row());
    if (!fits(stadium.columns(rows.row()), rows.row(), inside_by, surely, kWithRim + kUnits))
      return "a path has other cells";
  }
  if ((all & ~stadium.box()) != 0) return "the box of a path misses cells";
  for (int row = 0; row < kCells; ++row) {
    if ((visited >> row & 1U) == 0 && !fits(0, row, inside_by, 0, 0)) return "a row of a path is left out";
  }
  return "";
}

std::string judge_numbers(Dice& dice) {
  const int first = dice.index(kCells), last = dice.index(kCells + 1) - 1;
  Row due = 0;
  for (int i = first; i <= last; ++i) due |= Row{1} << i;
  if (columns_between(first, last) != due) return "other columns";
  const auto word = static_cast<Row>(dice.bits());
  int count = 0;
  for (int i = 0; i < kCells; ++i) count += static_cast<int>(word >> i & 1U);
  return bits(word) == count ? "" : "other bits";
}

}  // namespace

std::string judge_raster(Dice& dice) {
  for (int i = 0; i < 150; ++i) {
    for (const JudgePart judge : {judge_discs, judge_wedges, judge_echo_arc, judge_stadium, judge_numbers}) {
      std::string wrong = judge(dice);
      if (!wrong.empty()) return wrong;
    }
  }
  return "";
}

}  // namespace whisker::hunt
