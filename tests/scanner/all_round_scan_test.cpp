#include "host/lab/scanner/all_round_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/harness/scenario/shapes.hpp"
#include "host/harness/sim/elementary.hpp"

namespace whisker::scanner {
namespace {

using sim::Vec2;

constexpr double kRange = 2;
constexpr double kRay = 2 * sim::kPi / 1440;  // rad between two rays

World seen_from(const World& world, Vec2 at, double range = kRange) {
  const std::vector<sim::Segment> all = outlines(world);
  SeenOutlines seen(all);
  scan_all_round(all, at, range, seen);
  return seen.known();
}

bool some_near(const World& known, Vec2 at, double within_m) {
  return std::any_of(known.segments.begin(), known.segments.end(),
                     [&](const sim::Segment& s) { return distance(at, s) <= within_m; });
}

TEST(Outlines, OfADiscLieOnItsRimAndLittleInside) {
  for (const double radius : {0.01, 0.1, 0.8}) {
    World world;
    world.segments = {{{5, 5}, {6, 5}}};
    world.discs = {{{1, 2}, radius}};
    const std::vector<sim::Segment> all = outlines(world);
    EXPECT_GE(all.size(), 9U);
    for (std::size_t i = 1; i < all.size(); ++i) {
      EXPECT_NEAR(distance({1, 2}, all[i].a), radius, 1e-12);
      EXPECT_GE(distance({1, 2}, all[i]), radius - 0.002);
      const sim::Segment& next = all[i + 1 < all.size() ? i + 1 : 1];
      EXPECT_EQ(distance(all[i].b, next.a), 0);
    }
  }
}

TEST(Look, SeesTheNearSideOfADisc) {
  World world;
  world.discs = {{{1.5, 0}, 0.3}};
  const World known = seen_from(world, {0, 0});
  EXPECT_TRUE(some_near(known, {1.2, 0}, 0.002));
  const double touch = 1.5 - 0.3 * 0.3 / 1.5;  // where a line of sight is tangent to the disc
  for (const sim::Segment& s : known.segments) EXPECT_LT(std::max(s.a.x, s.b.x), touch + 0.06);
  EXPECT_TRUE(some_near(known, {touch, 0.29}, 0.06));
  EXPECT_TRUE(some_near(known, {touch, -0.29}, 0.06));
}

TEST(Look, SeesWhatIsWithinItsRange) {
  World world;
  world.discs = {{{-2.2, 0}, 0.3}, {{0, 2.4}, 0.3}};
  const World known = seen_from(world, {0, 0});
  EXPECT_TRUE(some_near(known, {-1.9, 0}, 0.002));
  EXPECT_FALSE(some_near(known, {0, 2.4}, 0.31));
}

TEST(Look, SeesAPoleAtItsFarthestWhereverItStands) {
  for (int i = 0; i < 1000; ++i) {
    World world;
    world.discs = {{{1.99 * std::cos(i * 0.71), 1.99 * std::sin(i * 0.71)}, 0.01}};
    EXPECT_FALSE(seen_from(world, {0, 0}).segments.empty()) << i;
  }
}

TEST(Look, SeesAsMuchOfAWallAsLiesWithinItsRange) {
  World world;
  world.segments = {{{-10, 1}, {10, 1}}};
  const World known = seen_from(world, {0, 0});
  ASSERT_EQ(known.segments.size(), 1U);
  const double half = std::sqrt(3);
  EXPECT_NEAR(known.segments[0].a.x, -half, 4 * kRay) << "a ray meets it 4 times as slantingly there";
  EXPECT_NEAR(known.segments[0].b.x, half, 4 * kRay);
  EXPECT_LE(std::fabs(known.segments[0].a.x), half + 1e-9);
}

TEST(Look, SeesNothingThroughAWall) {
  World world;
  world.segments = {{{1, -1}, {1, 1}}, {{1.5, -5}, {1.5, 5}}};
  world.discs = {{{1.4, 0}, 0.1}, {{1.3, 0.8}, 0.1}};
  const World known = seen_from(world, {0, 0}, 4);
  EXPECT_FALSE(some_near(known, {1.4, 0}, 0.09));
  EXPECT_FALSE(some_near(known, {1.3, 0.8}, 0.11));
  ASSERT_EQ(known.segments.size(), 3U) << "the near wall, and the far one on both sides of its shadow";
  EXPECT_EQ(distance(known.segments[0].a, known.segments[0].b), 2);
  EXPECT_NEAR(known.segments[1].b.y, -1.5, 0.02);
  EXPECT_NEAR(known.segments[2].a.y, 1.5, 0.02);
}

TEST(Look, SeesNothingThroughTheCornersOfABox) {
  for (int turn = 0; turn < 90; ++turn) {
    World world;
    const auto corner = [&](int i, double out) {
      const double angle = (turn + 90 * i) * sim::kPi / 180;
      return Vec2{out * std::cos(angle), out * std::sin(angle)};
    };
    for (int i = 0; i < 4; ++i) {
      world.segments.push_back({corner(i, 1), corner(i + 1, 1)});
      world.discs.push_back({corner(i, 1.2), 0.1});
    }
    const World known = seen_from(world, {0.13, -0.08}, 4);
    ASSERT_EQ(known.segments.size(), 4U) << turn;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(distance(known.segments[i].a, world.segments[i].a), 0) << turn;
      EXPECT_EQ(distance(known.segments[i].b, world.segments[i].b), 0) << turn;
    }
  }
}

TEST(Look, SeesTheEndOfAWallThatPointsAtIt) {
  World world;
  world.segments = {{{1, 0}, {5, 0}}};
  const World known = seen_from(world, {0, 0});
  ASSERT_EQ(known.segments.size(), 1U);
  EXPECT_EQ(known.segments[0].a.x, 1);
  EXPECT_EQ(known.segments[0].b.x, 1);
}

TEST(SeenOutlines, PutsTogetherWhatTwoLooksShow) {
  const std::vector<sim::Segment> wall = {{{0, 0}, {10, 0}}};
  SeenOutlines seen(wall);
  seen.add(0, {0.5, 0.6});
  seen.add(0, {0.1, 0.2});
  EXPECT_EQ(seen.take_new().segments.size(), 2U);
  EXPECT_EQ(seen.known().segments.size(), 2U);
  seen.add(0, {0.12, 0.19});
  EXPECT_TRUE(seen.take_new().segments.empty()) << "known already";
  seen.add(0, {0.2015, 0.55});
  EXPECT_EQ(seen.take_new().segments.size(), 1U);
  const World known = seen.known();
  ASSERT_EQ(known.segments.size(), 1U) << "15 mm are no gap";
  EXPECT_DOUBLE_EQ(known.segments[0].a.x, 1);
  EXPECT_DOUBLE_EQ(known.segments[0].b.x, 6);
}

TEST(SeenOutlines, KnowsWhatTheBodyMet) {
  const std::vector<sim::Segment> walls = {{{0.12, -1}, {0.12, 1}}, {{0.07, -1}, {0.07, 1}}};
  SeenOutlines seen(walls);
  seen.add_near({0, 0}, 0.1);
  const World known = seen.known();
  ASSERT_EQ(known.segments.size(), 1U);
  EXPECT_DOUBLE_EQ(known.segments[0].a.x, 0.07);
  EXPECT_DOUBLE_EQ(known.segments[0].a.y, 0);
}

}  // namespace
}  // namespace whisker::scanner
