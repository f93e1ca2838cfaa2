#include "firmware/perception/raster.hpp"

#include "firmware/perception/grid_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "host/harness/worlds/random.hpp"

namespace whisker::test {
namespace {

using namespace perception;
using worlds::Random;

constexpr double kTurn = 2 * 3.14159265358979323846;
// Error of a Q14 normal over the longest distance, plus the roundings to whole units.
constexpr double kUnits = 4;
// The rim of cells on a diagonal, plus the roundings.
constexpr double kWithRim = kRim * 1.4143 + 3;

double centre(int cell) { return cell * kUnitsPerCell + kHalfCell; }
double radians_of(Angle a) { return a.wrapped() * (kTurn / 4294967296.0); }

/// On an axis, next to one, or anywhere.
Angle draw_angle(Random& random) {
  if (random.chance(0.4)) {
    return Angle::turns(random.index(8), 8) +
           Angle::from_raw(static_cast<std::uint32_t>(random.index(5)) - 2U);
  }
  return Angle::from_raw(static_cast<std::uint32_t>(random.bits()));
}

/// Within the window, on its edges, or at the limits.
int32_t draw_coordinate(Random& random) {
  switch (random.index(4)) {
    case 0: return random.index(3) * kCells * kUnitsPerCell / 2;
    case 1: return random.index(2) == 0 ? -kOutermost : kOutermost;
    case 2: return random.index(2 * kOutermost + 1) - kOutermost;
    default: return random.index(kCells * kUnitsPerCell);
  }
}

int32_t draw_length(Random& random) {
  switch (random.index(5)) {
    case 0: return 0;
    case 1: return kLongest;
    case 2: return random.index(kLongest);
    case 3: return -random.index(1000);
    default: return random.index(20 * kUnitsPerCell);
  }
}

/// A column whose true measure exceeds `surely` must be inside, one below -`surely_not` must be outside.
template <class F>
void expect_row(Row row, F&& inside_by, const char* what, std::uint64_t seed, int line,
                double surely = kUnits, double surely_not = kUnits) {
  for (int column = 0; column < kCells; ++column) {
    const double by = inside_by(centre(column), centre(line));
    const bool in = (row >> column & 1U) != 0;
    if (by > surely) {
      ASSERT_TRUE(in) << what << " seed " << seed << " column " << column << " by " << by;
    }
    if (by < -surely_not) {
      ASSERT_FALSE(in) << what << " seed " << seed << " column " << column << " by " << by;
    }
  }
}

TEST(Raster, ColumnsAreTheBitsFromFirstToLast) {
  for (int first = 0; first < kCells; ++first) {
    for (int last = -1; last < kCells; ++last) {
      Row expected = 0;
      for (int i = first; i <= last; ++i) expected |= 1U << i;
      ASSERT_EQ(columns_between(first, last), expected);
      ASSERT_EQ(bits(expected), last < first ? 0 : last - first + 1);
    }
  }
}

TEST(Raster, DivisionsRoundTowardsTheirSide) {
  for (int32_t n = -1000; n <= 1000; ++n) {
    for (int32_t d = 1; d < 40; ++d) {
      ASSERT_EQ(floor_div(n, d), static_cast<int32_t>(std::floor(n / static_cast<double>(d))));
      ASSERT_EQ(ceil_div(n, d), static_cast<int32_t>(std::ceil(n / static_cast<double>(d))));
    }
  }
}

TEST(Raster, DiscHoldsTheCellsWhoseCentresLieInIt) {
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Random random(seed);
    const int32_t x = draw_coordinate(random);
    const int32_t y = draw_coordinate(random);
    const int32_t radius = draw_length(random);
    std::uint32_t visited = 0;
    for (Rows rows(y, radius); rows.more(); rows.next()) {
      ASSERT_TRUE(rows.row() >= 0 && rows.row() < kCells);
      visited |= 1U << rows.row();
      Span span;
      span.within_disc(x, rows.offset(y), radius);
      expect_row(
          span.columns(), [&](double cx, double cy) { return radius - std::hypot(cx - x, cy - y); }, "disc",
          seed, rows.row());
      if (HasFatalFailure()) return;
    }
    for (int row = 0; row < kCells; ++row) {
      const bool reached = std::fabs(centre(row) - y) <= radius;
      ASSERT_EQ((visited >> row & 1U) != 0, reached) << "seed " << seed << " row " << row;
    }
  }
}

TEST(Raster, WedgeKeepsTheMarginInsideBothEdges) {
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Random random(seed);
    const int32_t x = draw_coordinate(random);
    const int32_t y = draw_coordinate(random);
    const Angle axis = draw_angle(random);
    const Angle half = Angle::turns(1 + random.index(449), 3600);
    const int32_t margin = random.chance(0.3) ? draw_length(random) : random.index(2000) - 1000;
    const Wedge wedge(axis, half);
    const double a = radians_of(axis);
    const double h = radians_of(half);
    for (int row = 0; row < kCells; ++row) {
      Span span;
      wedge.clip(span, x, static_cast<int32_t>(centre(row)) - y, margin);
      const auto inside_by = [&](double cx, double cy) {
        const double dx = cx - x;
        const double dy = cy - y;
        const double left = dx * std::sin(a + h) - dy * std::cos(a + h);
        const double right = -dx * std::sin(a - h) + dy * std::cos(a - h);
        return std::fmin(left, right) - margin;
      };
      expect_row(span.empty() ? 0 : span.columns(), inside_by, "wedge", seed, row);
      if (HasFatalFailure()) return;
    }
  }
}

struct At {
  double x, y;
};

/// Distance of a point from the nearest and the farthest point of the cell around a centre.
double nearest(At cell, At p) {
  return std::hypot(std::fmax(std::fabs(cell.x - p.x) - kHalfCell, 0),
                    std::fmax(std::fabs(cell.y - p.y) - kHalfCell, 0));
}
double farthest(At cell, At p) {
  return std::hypot(std::fabs(cell.x - p.x) + kHalfCell, std::fabs(cell.y - p.y) + kHalfCell);
}

double from_segment(At p, At begin, At direction, double length) {
  const double along = (p.x - begin.x) * direction.x + (p.y - begin.y) * direction.y;
  const double on = std::fmin(std::fmax(along, 0), length);
  return std::hypot(p.x - begin.x - on * direction.x, p.y - begin.y - on * direction.y);
}

/// Distance between a cell and a segment that does not cross it completely.
double apart(At cell, At begin, At direction, double length) {
  double d = std::fmin(nearest(cell, begin),
                       nearest(cell, {begin.x + length * direction.x, begin.y + length * direction.y}));
  for (const double x : {cell.x - kHalfCell, cell.x + kHalfCell}) {
    for (const double y : {cell.y - kHalfCell, cell.y + kHalfCell}) {
      d = std::fmin(d, from_segment({x, y}, begin, direction, length));
    }
  }
  return d;
}

// Cells that are not completely inside are never held, and touched cells are never missed.
TEST(Raster, DiscsTouchAndHoldWholeCells) {
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Random random(seed);
    const int32_t x = draw_coordinate(random);
    const int32_t y = draw_coordinate(random);
    const int32_t radius = draw_length(random);
    const At middle{static_cast<double>(x), static_cast<double>(y)};
    for (int row = 0; row < kCells; ++row) {
      const auto dy = static_cast<int32_t>(centre(row)) - y;
      Span inside;
      inside.inside_disc(x, dy, radius);
      const auto held_by = [&](double cx, double cy) { return radius - farthest({cx, cy}, middle); };
      expect_row(inside.empty() ? 0 : inside.columns(), held_by, "held", seed, row, kWithRim, 0);
      if (HasFatalFailure()) return;
      if (radius < 0) continue;
      Span touched;
      touched.touched_by_disc(x, dy, radius);
      const auto touched_by = [&](double cx, double cy) { return radius - nearest({cx, cy}, middle); };
      expect_row(touched.empty() ? 0 : touched.columns(), touched_by, "touched", seed, row, 0, kWithRim);
      if (HasFatalFailure()) return;
    }
  }
}

template <bool kSteps>
std::uint64_t rows_of(const HalfPlane& plane, int32_t x, int32_t y, int32_t margin, int first) {
  std::uint64_t rows = 0;
  CutBy<kSteps> cut(plane, x, first * kUnitsPerCell + kHalfCell - y, margin);
  for (int row = first; row < kCells; ++row, cut.next()) {
    Span span;
    cut.clip(span, row * kUnitsPerCell + kHalfCell - y);
    rows = rows * 31 + (span.empty() ? 0 : span.columns());
  }
  return rows;
}

// Chips that divide slowly take the steps.
TEST(Raster, CutsInStepsAreTheSameAsByDivisions) {
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Random random(seed);
    const int32_t x = draw_coordinate(random);
    const int32_t y = draw_coordinate(random);
    const HalfPlane plane = HalfPlane::facing(draw_angle(random));
    const int32_t margin = random.index(1000) - 500;
    const int first = random.index(kCells);
    std::uint64_t divided = 0;
    for (int row = first; row < kCells; ++row) {
      Span span;
      plane.clip(span, x, row * kUnitsPerCell + kHalfCell - y, margin);
      divided = divided * 31 + (span.empty() ? 0 : span.columns());
    }
    ASSERT_EQ(rows_of<false>(plane, x, y, margin, first), divided) << seed;
    ASSERT_EQ(rows_of<true>(plane, x, y, margin, first), divided) << seed;
  }
}

TEST(Raster, WedgeHoldsWholeCells) {
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Random random(seed);
    const int32_t x = draw_coordinate(random);
    const int32_t y = draw_coordinate(random);
    const Angle axis = draw_angle(random);
    const Angle half = Angle::turns(1 + random.index(449), 3600);
    const Wedge wedge(axis, half);
    const double a = radians_of(axis);
    const double h = radians_of(half);
    for (int row = 0; row < kCells; ++row) {
      Span span;
      wedge.hold(span, x, static_cast<int32_t>(centre(row)) - y);
      const auto inside_by = [&](double cx, double cy) {
        double by = 1e9;
        for (const double dx : {cx - kHalfCell - x, cx + kHalfCell - x}) {
          for (const double dy : {cy - kHalfCell - y, cy + kHalfCell - y}) {
            by = std::fmin(by, dx * std::sin(a + h) - dy * std::cos(a + h));
            by = std::fmin(by, -dx * std::sin(a - h) + dy * std::cos(a - h));
          }
        }
        return by;
      };
      expect_row(span.empty() ? 0 : span.columns(), inside_by, "wedge", seed, row, kWithRim, 0);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Raster, StadiumTouchesWhatADiscSweepsAheadOfItsBeginning) {
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Random random(seed);
    const int32_t x = draw_coordinate(random);
    const int32_t y = draw_coordinate(random);
    const Angle heading = draw_angle(random);
    const int32_t length = std::abs(draw_length(random));
    const int32_t radius = kUnitsPerCell + std::abs(draw_length(random)) / 4;
    const int32_t abeam = random.index(200);
    const Stadium stadium({x, y, heading, length, radius, abeam});
    const At begin{static_cast<double>(x), static_cast<double>(y)};
    const At direction{std::cos(radians_of(heading)), std::sin(radians_of(heading))};
    std::uint32_t visited = 0;
    const auto inside_by = [&](double cx, double cy) {
      const double ahead = (cx - x) * direction.x + (cy - y) * direction.y - abeam;
      return std::fmin(radius - apart({cx, cy}, begin, direction, length), ahead);
    };
    for (Rows rows = stadium.rows(); rows.more(); rows.next()) {
      visited |= 1U << rows.row();
      expect_row(stadium.columns(rows.row()), inside_by, "stadium", seed, rows.row(), kUnits, kWithRim);
      if (HasFatalFailure()) return;
    }
    for (int row = 0; row < kCells; ++row) {
      if ((visited >> row & 1U) == 0) expect_row(0, inside_by, "row left out", seed, row, 0, 0);
      if (HasFatalFailure()) return;
    }
  }
}

/// Cells of every size, at the lengths where the units change, and at those where the factors do.
TEST(UnitsByProduct, AreThoseOfADivision) {
  Random random(29);
  for (int i = 0; i < 4000; ++i) {
    const int bits = 12 + random.index(16);
    const std::int32_t cell = i < 64    ? UnitsByProduct::kSmallest - 32 + i
                              : i < 128 ? (1 << (13 + i % 14)) - i % 3
                                        : (1 << bits) + random.index(1 << bits);
    const UnitsByProduct units(cell);
    const auto check = [&](std::int64_t um) {
      if (um < 0 || um > UnitsByProduct::kNear) return;
      std::int32_t rest = -1;
      const std::int64_t n = um * kUnitsPerCell;
      ASSERT_EQ(units.whole(static_cast<std::int32_t>(um), cell, rest), n / cell) << um << " um of " << cell;
      ASSERT_EQ(rest, n % cell) << um << " um of " << cell;
    };
    for (std::int64_t edge = 0; edge < 3; ++edge) check(edge), check(UnitsByProduct::kNear - edge);
    for (int k = 0; k < 200; ++k) {
      const std::int64_t um = random.index(UnitsByProduct::kNear);
      const std::int64_t step = um * kUnitsPerCell / cell * cell / kUnitsPerCell;
      for (const std::int64_t at : {um, um / 64 * 64, um / 64 * 64 + 63, step, step + 1}) check(at);
    }
  }
}

}  // namespace
}  // namespace whisker::test
