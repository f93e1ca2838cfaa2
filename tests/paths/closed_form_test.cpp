// Paths whose length has a closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "host/harness/scenario/shapes.hpp"
#include "host/harness/worlds/random.hpp"
#include "host/lab/paths/shortest.hpp"
#include "host/lab/paths/tangent.hpp"

namespace whisker::paths {
namespace {

using sim::Vec2;

constexpr double kExact = 1e-9;
const double kPi = std::acos(-1);

double shortest(const World& world, Vec2 from, Vec2 to, double radius) {
  return shortest_path(world, from, to, radius).value_or(-1);
}

TEST(ClosedForm, NothingInTheWay) {
  EXPECT_DOUBLE_EQ(shortest({}, {1, 2}, {4, 6}, 0.1), 5);
  EXPECT_EQ(shortest({}, {1, 2}, {1, 2}, 0.1), 0);
  World world;
  world.discs = {{{0, 0.5}, 0.4}};
  EXPECT_DOUBLE_EQ(shortest(world, {-1, 0}, {1, 0}, 0.1), 2) << "the line touches the inflated disc";
}

TEST(ClosedForm, AroundADisc) {
  for (const double radius : {0.01, 0.1, 0.25}) {
    for (const double off : {0.0, 0.03, -0.2}) {
      World world;
      world.discs = {{{0, off}, 0.5}};
      const double inflated = 0.5 + radius;
      const double d = std::hypot(2, off);
      // The path takes the side with the smaller part of the disc.
      const double up = 2 * std::acos(inflated / d) + 2 * std::atan2(std::fabs(off), 2);
      const double expected = 2 * std::sqrt(d * d - inflated * inflated) + inflated * (kPi - up);
      EXPECT_NEAR(shortest(world, {-2, 0}, {2, 0}, radius), expected, kExact) << radius << " " << off;
    }
  }
}

TEST(ClosedForm, OverTwoDiscsInARow) {
  constexpr double kRadius = 0.1, kGrown = 0.6, kApart = 1.5, kBelow = 0.2, kFrom = 3;
  World world;
  world.discs = {{{-kApart, -kBelow}, 0.5}, {{kApart, -kBelow}, 0.5}, {{0, -kBelow - 0.05}, 0.5}};
  const double d = std::hypot(kFrom - kApart, kBelow);
  const double rise = std::asin(kGrown / d) - std::atan2(kBelow, kFrom - kApart);
  const double expected = 2 * (std::sqrt(d * d - kGrown * kGrown) + kGrown * rise + kApart);
  EXPECT_NEAR(shortest(world, {-kFrom, 0}, {kFrom, 0}, kRadius), expected, kExact);
}

TEST(ClosedForm, BetweenTwoDiscsFromOneSideToTheOther) {
  // Start and goal are mirrored at the origin; the path crosses it along the inner tangent of the two discs.
  constexpr double kGrown = 0.6;
  World world;
  world.discs = {{{-1, 0.5}, 0.5}, {{1, -0.5}, 0.5}, {{-1, -4}, 3.8}, {{1, 4}, 3.8}};
  const Vec2 from{-3, 0.5};
  const double to_centre = std::hypot(1, 0.5);
  const double heading = std::atan2(-0.5, 1) + std::asin(kGrown / to_centre);
  const double first = std::sqrt(4 - kGrown * kGrown);
  const double start = -std::asin(kGrown / 2);
  const double expected =
      2 * (first + kGrown * (heading - start) + std::sqrt(to_centre * to_centre - kGrown * kGrown));
  EXPECT_NEAR(shortest(world, from, from * -1, 0.1), expected, kExact);
}

TEST(ClosedForm, AroundTheEndOfAWall) {
  for (const double radius : {0.05, 0.1, 0.4}) {
    World world;
    world.segments = {{{0, -5}, {0, 1}}};
    const double lean = kPi / 4 + std::asin(radius / std::sqrt(2));
    const double expected = 2 * (std::sqrt(2 - radius * radius) + radius * lean);
    EXPECT_NEAR(shortest(world, {-1, 0}, {1, 0}, radius), expected, kExact) << radius;
  }
}

World u_of_walls() {
  World world;
  world.segments = {{{0, -1}, {0, 1}}, {{0, 1}, {2, 1}}, {{2, -1}, {0, -1}}};
  return world;
}

double out_of_the_u(double radius) {
  const double lean = std::asin(radius / std::sqrt(2));
  return 2 * std::sqrt(2 - radius * radius) + 2 + radius * (kPi + 2 * lean);
}

TEST(ClosedForm, OutOfAU) {
  for (const double radius : {0.02, 0.1, 0.5}) {
    EXPECT_NEAR(shortest(u_of_walls(), {1, 0}, {-1, 0}, radius), out_of_the_u(radius), kExact) << radius;
  }
}

TEST(ClosedForm, AWallInPiecesIsTheSameWall) {
  World pieces;
  for (const sim::Segment& s : u_of_walls().segments) {
    for (int i = 0; i < 7; ++i) {
      pieces.segments.push_back({s.a + (s.b - s.a) * (i / 7.0), s.a + (s.b - s.a) * ((i + 1) / 7.0)});
      pieces.segments.push_back({s.a, s.a});
    }
  }
  EXPECT_NEAR(shortest(pieces, {1, 0}, {-1, 0}, 0.1), out_of_the_u(0.1), kExact);
}

TEST(ClosedForm, RepeatedObstaclesChangeNothing) {
  World world = u_of_walls();
  const World once = world;
  world.segments.insert(world.segments.end(), once.segments.rbegin(), once.segments.rend());
  world.discs = {{{2, 1}, 1e-12}, {{0, 1}, 0.0}, {{0, 1}, 0.0}};
  EXPECT_NEAR(shortest(world, {1, 0}, {-1, 0}, 0.1), out_of_the_u(0.1), kExact);
}

TEST(ClosedForm, APolygonOfManySidesIsNearlyADisc) {
  World disc, polygon;
  disc.discs = {{{0, 0.1}, 0.5}};
  constexpr int kSides = 360;
  for (int i = 0; i < kSides; ++i) {
    const auto corner = [](int k) {
      const double angle = 2 * kPi * k / kSides;
      return Vec2{0.5 * std::cos(angle), 0.1 + 0.5 * std::sin(angle)};
    };
    polygon.segments.push_back({corner(i), corner(i + 1)});
  }
  const double round = shortest(disc, {-2, 0}, {2, 0}, 0.1);
  const double edged = shortest(polygon, {-2, 0}, {2, 0}, 0.1);
  EXPECT_LT(edged, round);
  EXPECT_NEAR(edged, round, 1e-4);
}

TEST(ClosedForm, AGapIsPassedWhenTheBodyFits) {
  for (const double width : {0.2 - 1e-7, 0.2, 0.2 + 1e-7}) {
    World walls;
    walls.segments = {{{0, -50}, {0, 0}}, {{0, width}, {0, 50}}};
    World discs;
    discs.discs = {{{0, -1}, 1}, {{0, width + 1}, 1}, {{0, -41}, 39}, {{0, width + 41}, 39}};
    const bool fits = width > 0.2 - 1e-8;
    const double middle = width / 2;
    EXPECT_EQ(shortest_path(walls, {-1, middle}, {1, middle}, 0.1).has_value(), true) << "around the ends";
    const double through = shortest(walls, {-1, middle}, {1, middle}, 0.1);
    EXPECT_EQ(std::fabs(through - 2) < 1e-6, fits) << width;
    EXPECT_EQ(std::fabs(shortest(discs, {-2, middle}, {2, middle}, 0.1) - 4) < 1e-6, fits) << width;
  }
}

TEST(ClosedForm, NoWayIsNone) {
  World ring;
  ring.segments = {{{-1, -1}, {1, -1}}, {{1, -1}, {1, 1}}, {{1, 1}, {-1, 1}}, {{-1, 1}, {-1, -1}}};
  EXPECT_FALSE(shortest_path(ring, {0, 0}, {3, 0}, 0.1));
  EXPECT_FALSE(shortest_path(ring, {3, 0}, {0, 0}, 0.1));
  EXPECT_FALSE(shortest_path(ring, {0, 0}, {0.95, 0}, 0.1)) << "the goal is too near to a wall";
  EXPECT_FALSE(shortest_path(ring, {0.95, 0}, {0, 0}, 0.1)) << "the start is too near to a wall";
  EXPECT_DOUBLE_EQ(shortest(ring, {-0.9, 0}, {0.9, 0}, 0.1), 1.8) << "both touch";
  World disc;
  disc.discs = {{{3, 0}, 0.5}};
  EXPECT_FALSE(shortest_path(disc, {0, 0}, {3, 0.2}, 0.1));
}

constexpr Side kSides[] = {Side::left, Side::right};

/// Signed distance of the centre to the left of the directed line.
double left_of(const sim::Segment& line, Vec2 centre) {
  return sim::cross((line.b - line.a) * (1 / distance(line.a, line.b)), centre - line.a);
}

TEST(Tangent, TouchesBothDiscsOnTheSidesAskedFor) {
  worlds::Random random(7);
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const sim::Disc a{{random.uniform(-1, 1), random.uniform(-1, 1)}, random.uniform(0, 1)};
    const sim::Disc b{{random.uniform(-1, 1), random.uniform(-1, 1)},
                      random.chance(0.1) ? 0 : random.uniform(0, 1)};
    const double d = distance(a.center, b.center);
    for (const Side side_a : kSides) {
      for (const Side side_b : kSides) {
        const auto t = tangent(a, side_a, b, side_b);
        const double least = side_a == side_b ? std::fabs(a.radius - b.radius) : a.radius + b.radius;
        ASSERT_EQ(t.has_value(), d > least) << i;
        if (!t || t->length_m < 1e-3) continue;
        ++found;
        EXPECT_NEAR(distance(t->line.a, t->line.b), t->length_m, 1e-12);
        EXPECT_NEAR(distance(t->line.a, a.center), a.radius, 1e-12);
        EXPECT_NEAR(distance(t->line.b, b.center), b.radius, 1e-12);
        EXPECT_NEAR(left_of(t->line, a.center), a.radius * static_cast<int>(side_a), 1e-9);
        EXPECT_NEAR(left_of(t->line, b.center), b.radius * static_cast<int>(side_b), 1e-9);
      }
    }
  }
  EXPECT_GT(found, 3000);
}

TEST(Tangent, APointOnTheRimHasOneOfNoLength) {
  const sim::Disc disc{{0, 0}, 0.5};
  for (const double radius : {0.5, 0.5 - 1e-12, 0.5 + 1e-12}) {
    const auto t = tangent({{0, radius}, 0}, Side::left, disc, Side::right);
    ASSERT_TRUE(t);
    EXPECT_LT(t->length_m, 2e-6);
    EXPECT_NEAR(t->normal.y, 1, 1e-5);
  }
}

}  // namespace
}  // namespace whisker::paths
