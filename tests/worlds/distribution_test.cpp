#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host/harness/scenario/shapes.hpp"
#include "host/harness/scenario/world.hpp"
#include "host/harness/worlds/direction.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/reach.hpp"

namespace whisker::worlds {
namespace {

using sim::Vec2;

constexpr std::uint64_t kSeeds = 200;
constexpr double kRounding = 2e-4;  // coordinates are whole 0.1 mm

/// Statistics of a number over many worlds.
struct Spread {
  double low = 1e9, high = -1e9;
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  /// Within the range, and using most of it.
  void expect(double from, double to, const char* what) const {
    const double tail = (to - from) * 0.1;
    EXPECT_GE(low, from - kRounding) << what;
    EXPECT_LE(high, to + kRounding) << what;
    EXPECT_LE(low, from + tail) << what;
    EXPECT_GE(high, to - tail) << what;
  }
};

void expect_discs_keep_off(const Scenario& s) {
  for (const sim::Disc& d : s.discs) {
    EXPECT_GE(distance(d.center, s.start.at), d.radius + kKeptFree - 1e-12);
    EXPECT_GE(distance(d.center, s.goal.at), d.radius + kKeptFree - 1e-12);
  }
}

TEST(Discs, AreThirtyOfAnySizeBetweenStartAndGoal) {
  Spread radius, place;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scenario s = generate(Kind::discs, {seed, {}, false, false});
    ASSERT_EQ(s.discs.size(), 30U);
    EXPECT_FALSE(s.bounds.has_value());
    EXPECT_EQ(distance(s.start.at, Vec2{0, 0}) + distance(s.goal.at, Vec2{8, 8}), 0);
    expect_discs_keep_off(s);
    for (const sim::Disc& d : s.discs) {
      radius.add(d.radius);
      place.add(d.center.x);
      place.add(d.center.y);
    }
  }
  radius.expect(0.15, 0.8, "radius");
  place.expect(-0.5, 8.5, "place");
}

TEST(Discs, InABoxAreSmaller) {
  Spread radius;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Scenario s = generate(Kind::discs, {seed, 75, true, false});
    ASSERT_EQ(s.discs.size(), 75U);
    ASSERT_TRUE(s.bounds.has_value());
    EXPECT_EQ(s.bounds->min.x, -0.8);
    EXPECT_EQ(s.bounds->max.y, 8.8);
    for (const sim::Disc& d : s.discs) radius.add(d.radius);
  }
  radius.expect(0.15, 0.6, "radius");
}

TEST(Poles, AreAHundredBesideTwelveDiscs) {
  Spread disc, pole;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Scenario s = generate(Kind::poles, {seed, {}, false, false});
    ASSERT_EQ(s.discs.size(), 112U);
    expect_discs_keep_off(s);
    for (std::size_t i = 0; i < s.discs.size(); ++i) (i < 12 ? disc : pole).add(s.discs[i].radius);
  }
  disc.expect(0.15, 0.8, "disc");
  pole.expect(0.01, 0.03, "pole");
}

TEST(UTrap, HasTheStatedShape) {
  Spread width, depth, behind, from_start;
  int inside_it = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scenario s = generate(Kind::u_trap, {seed, {}, false, false});
    ASSERT_EQ(s.polygons.size(), 1U);
    const auto& u = s.polygons[0];
    ASSERT_EQ(u.size(), 8U);
    width.add(distance(u[3], u[4]));
    depth.add(distance(u[2], u[3]));
    EXPECT_NEAR(distance(u[1], u[2]), 0.1, kRounding);
    const Vec2 back = (u[0] + u[7]) * 0.5;
    const Vec2 open = (u[2] + u[5]) * 0.5 - (u[3] + u[4]) * 0.5;
    behind.add(distance(back, s.goal.at));
    const double cosine = dot(back - s.goal.at, open) / distance(back, s.goal.at) / distance({0, 0}, open);
    EXPECT_GE(cosine, std::cos(30.2 / 180 * std::acos(-1))) << seed;
    const bool in = inside(s.start.at, {u[2], u[3], u[4], u[5]});
    inside_it += in ? 1 : 0;
    if (!in) from_start.add(distance(s.start.at, (u[2] + u[5] + u[3] + u[4]) * 0.25));
  }
  width.expect(0.6, 4, "width");
  depth.expect(0.5, 3, "depth");
  behind.expect(0.3, 3, "goal behind");
  from_start.expect(3, 7, "from start");
  // A third of 200 worlds, within four standard deviations.
  EXPECT_NEAR(inside_it, 67, 27);
}

TEST(Spiral, IsOfThinWallsIntoOrOutOfThem) {
  int into = 0;
  std::size_t fewest = 99, most = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scenario s = generate(Kind::spiral, {seed, {}, false, false});
    Vec2 low{1e9, 1e9}, high{-1e9, -1e9};
    for (const auto& bar : s.polygons) {
      ASSERT_EQ(bar.size(), 4U);
      EXPECT_NEAR(std::min(distance(bar[0], bar[1]), distance(bar[1], bar[2])), 0.04, 2 * kRounding);
      for (const Vec2 p : bar) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
    }
    fewest = std::min(fewest, s.polygons.size());
    most = std::max(most, s.polygons.size());
    const Vec2 middle = (low + high) * 0.5;
    into += distance(middle, s.goal.at) < distance(middle, s.start.at) ? 1 : 0;
  }
  EXPECT_EQ(fewest, 4U);
  EXPECT_EQ(most, 9U);
  EXPECT_NEAR(into, 100, 28);
}

TEST(Maze, HasFiveToEightCellsASide) {
  Spread cell;
  std::array<int, 9> sides{};
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scenario s = generate(Kind::maze, {seed, {}, false, false});
    ASSERT_TRUE(s.bounds.has_value());
    const double size = -2 * s.bounds->min.x;
    cell.add(size);
    const double side = (s.bounds->max.x - s.bounds->min.x) / size;
    ASSERT_NEAR(side, std::round(side), 2e-3);
    ASSERT_TRUE(side > 4.5 && side < 8.5);
    ++sides[static_cast<std::size_t>(side + 0.5)];
    EXPECT_NEAR(s.goal.at.x, (std::round(side) - 1) * size, 2e-3);
    for (const auto& bar : s.polygons) {
      EXPECT_NEAR(std::min(distance(bar[0], bar[1]), distance(bar[1], bar[2])), 0.02, kRounding);
    }
  }
  cell.expect(0.7, 1.0, "cell");
  for (std::size_t side = 5; side <= 8; ++side) EXPECT_NEAR(sides[side], 50, 25) << side;
}

/// The widths of the openings in the walls along one line between the rooms.
std::vector<double> openings(const Scenario& s, bool upright, double line) {
  std::vector<std::pair<double, double>> bars;
  for (const auto& bar : s.polygons) {
    const Vec2 low{std::min(bar[0].x, bar[2].x), std::min(bar[0].y, bar[2].y)};
    const Vec2 high{std::max(bar[0].x, bar[2].x), std::max(bar[0].y, bar[2].y)};
    const bool on_line =
        upright ? low.x > line - 0.02 && high.x < line + 0.02 : low.y > line - 0.02 && high.y < line + 0.02;
    if (on_line) bars.push_back(upright ? std::pair{low.y, high.y} : std::pair{low.x, high.x});
  }
  std::sort(bars.begin(), bars.end());
  std::vector<double> widths;
  for (std::size_t i = 0; i + 1 < bars.size(); ++i) {
    if (bars[i + 1].first > bars[i].second + 1e-9) widths.push_back(bars[i + 1].first - bars[i].second);
  }
  return widths;
}

TEST(Rooms, AreJoinedByDoorsOfTheStatedWidths) {
  Spread width, radius;
  double doors = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scenario s = generate(Kind::rooms, {seed, {}, false, false});
    ASSERT_EQ(s.discs.size(), 4U);
    expect_discs_keep_off(s);
    for (const sim::Disc& d : s.discs) radius.add(d.radius);
    std::size_t here = 0;
    for (const bool upright : {true, false}) {
      for (const double line : {2.5, 5.0}) {
        for (const double w : openings(s, upright, line)) {
          width.add(w);
          ++here;
        }
      }
    }
    EXPECT_GE(here, 8U);
    EXPECT_LE(here, 12U);
    doors += static_cast<double>(here);
  }
  width.expect(0.3, 0.6, "door");
  radius.expect(0.08, 0.25, "radius");
  // A tree of 8 doors, and 30 % of the other 4 walls.
  EXPECT_NEAR(doors / kSeeds, 9.2, 0.35);
}

TEST(Enclosed, IsShutInEachOfTheThreeWays) {
  Spread apothem;
  int around_goal = 0, around_start = 0, in_disc = 0;
  std::array<int, 8> sides{};
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scenario s = generate(Kind::enclosed, {seed, {}, false, false});
    if (s.walls.empty()) {
      ++in_disc;
      const sim::Disc& d = s.discs.back();
      EXPECT_LT(distance(d.center, s.goal.at), d.radius - s.goal.tolerance_m);
      continue;
    }
    const auto& fence = s.walls[0];
    EXPECT_EQ(distance(fence.front(), fence.back()), 0);
    const std::vector<Vec2> polygon(fence.begin(), fence.end() - 1);
    ++sides[polygon.size()];
    const bool goal = inside(s.goal.at, polygon);
    EXPECT_NE(goal, inside(s.start.at, polygon));
    (goal ? around_goal : around_start) += 1;
    apothem.add(distance(goal ? s.goal.at : s.start.at, fence));
  }
  apothem.expect(0.4, 1.4, "apothem");
  for (const int count : {around_goal, around_start, in_disc}) EXPECT_NEAR(count, 67, 27);
  for (std::size_t n = 3; n <= 7; ++n) EXPECT_GT(sides[n], 8) << n;
}

/// Whether a point of the fence lies outside the box.
bool crosses(const std::vector<Vec2>& fence, const Bounds& box) {
  return std::any_of(fence.begin(), fence.end(), [&](Vec2 p) {
    return p.x < box.min.x || p.y < box.min.y || p.x > box.max.x || p.y > box.max.y;
  });
}

TEST(EnclosedAtWall, HasAFenceAroundTheGoalThatCrossesTheBox) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Scenario s = generate(Kind::enclosed_at_wall, {seed, {}, false, false});
    ASSERT_TRUE(s.bounds.has_value());
    ASSERT_EQ(s.walls.size(), 1U);
    const auto& fence = s.walls[0];
    EXPECT_EQ(distance(fence.front(), fence.back()), 0);
    EXPECT_TRUE(inside(s.goal.at, {fence.begin(), fence.end() - 1})) << seed;
    EXPECT_TRUE(crosses(fence, *s.bounds)) << seed;
  }
}

TEST(GapAtWall, LeavesOneGapInTheFence) {
  Spread gap;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scenario s = generate(Kind::gap_at_wall, {seed, {}, false, false});
    ASSERT_TRUE(s.bounds.has_value());
    ASSERT_EQ(s.walls.size(), 1U);
    gap.add(distance(s.walls[0].front(), s.walls[0].back()));
  }
  gap.expect(0.26, 0.6, "gap");
}

TEST(Gap, HasTheWidthBetweenWallsAndBetweenDiscs) {
  Spread middle;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    for (const double width : {0.2, 0.32}) {
      Options o;
      o.seed = seed;
      o.gap_m = width;
      const Scenario walls = generate(Kind::gap, o);
      ASSERT_EQ(walls.polygons.size(), 2U);
      double least = 100;
      for (const Vec2 a : walls.polygons[0]) {
        for (const Vec2 b : walls.polygons[1]) least = std::min(least, distance(a, b));
      }
      EXPECT_NEAR(least, width, 2 * kRounding) << seed;
      const Scenario discs = generate(Kind::disc_gap, o);
      ASSERT_EQ(discs.discs.size(), 2U);
      const Vec2 a = discs.discs[0].center, b = discs.discs[1].center;
      EXPECT_NEAR(distance(a, b) - 0.4, width, 2 * kRounding) << seed;
      middle.add((a.y + b.y) / 2);
    }
  }
  middle.expect(-0.8, 0.8, "middle of the gap");
}

TEST(Gap, HasNoOtherWayThroughItsWall) {
  Options o;
  o.gap_m = 0.2;
  for (const Kind kind : {Kind::gap, Kind::disc_gap}) {
    for (o.seed = 1; o.seed <= 20; ++o.seed) {
      const Scenario s = generate(kind, o);
      const World world = make_world(s);
      EXPECT_TRUE(path_ruled_out(world, s.start.at, s.goal.at, s.goal.tolerance_m, 0.1 + kPathBand + 0.001));
    }
  }
}

TEST(ContestMaze, HasItsGoalInTheMiddleOf32By32Cells) {
  const Scenario s = generate(Kind::contest_maze, {1, {}, false, false});
  ASSERT_TRUE(s.bounds.has_value());
  EXPECT_NEAR(s.bounds->max.x - s.bounds->min.x, 32 * 0.54, kRounding);
  EXPECT_NEAR(s.bounds->max.y - s.bounds->min.y, 32 * 0.54, kRounding);
  EXPECT_NEAR(s.goal.at.x, 16 * 0.54, kRounding);
  EXPECT_NEAR(s.goal.at.y, 16 * 0.54, kRounding);
}

TEST(Direction, AgreesWithTheLibraryAllAround) {
  const double pi = std::acos(-1);
  for (int i = -7200; i <= 7200; ++i) {
    const double degrees = i / 10.0;
    const sim::Vec2 v = direction(degrees);
    EXPECT_NEAR(v.x, std::cos(degrees / 180 * pi), 3e-15) << degrees;
    EXPECT_NEAR(v.y, std::sin(degrees / 180 * pi), 3e-15) << degrees;
    EXPECT_NEAR(v.x * v.x + v.y * v.y, 1, 1e-15) << degrees;
  }
}

TEST(Direction, IsExactOnTheAxes) {
  for (int turn = -2; turn <= 2; ++turn) {
    EXPECT_EQ(direction(360 * turn).x, 1);
    EXPECT_EQ(direction(360 * turn + 90).y, 1);
    EXPECT_EQ(direction(360 * turn + 180).x, -1);
    EXPECT_EQ(direction(360 * turn + 270).y, -1);
  }
}

}  // namespace
}  // namespace whisker::worlds
