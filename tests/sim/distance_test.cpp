#include "host/sim/distance.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <vector>

#include "tests/sim/generators.hpp"

namespace whisker::sim {
namespace {

TEST(Distance, ToADiscIsNegativeInside) {
  const Disc disc{{1, 2}, 0.5};
  EXPECT_DOUBLE_EQ(signed_distance({1, 2}, disc), -0.5);
  EXPECT_DOUBLE_EQ(signed_distance({4, 6}, disc), 4.5);
  EXPECT_DOUBLE_EQ(signed_distance({1.5, 2}, disc), 0);
}

TEST(Distance, ToASegmentMeetsItsInsideOrItsEnds) {
  const Segment s{{0, 0}, {4, 0}};
  EXPECT_DOUBLE_EQ(distance({2, 3}, s), 3);
  EXPECT_DOUBLE_EQ(distance({-3, 4}, s), 5);
  EXPECT_DOUBLE_EQ(distance({7, -4}, s), 5);
  EXPECT_DOUBLE_EQ(distance({1, 0}, s), 0);
}

TEST(Distance, ToASegmentOfNoLengthIsToItsPoint) { EXPECT_DOUBLE_EQ(distance({3, 4}, {{0, 0}, {0, 0}}), 5); }

TEST(Distance, ToASegmentAgreesWithATernarySearchAlongIt) {
  EXPECT_TRUE(rc::check([] {
    const Vec2 p = point(3);
    const Segment s{point(3), point(3)};
    // The distance is convex along the segment.
    const auto at = [&](double t) {
      return std::hypot(p.x - s.a.x - t * (s.b.x - s.a.x), p.y - s.a.y - t * (s.b.y - s.a.y));
    };
    double low = 0, high = 1;
    for (int i = 0; i < 100; ++i) {
      const double m1 = low + (high - low) / 3, m2 = high - (high - low) / 3;
      (at(m1) < at(m2) ? high : low) = at(m1) < at(m2) ? m2 : m1;
    }
    // Near the minimum, the search cannot resolve steps below the square root of the precision.
    RC_ASSERT(std::fabs(distance(p, s) - at(0.5 * (low + high))) < 1e-7);
  }));
}

TEST(Contains, ASquareHoldsItsMiddleAndNotItsOutside) {
  for (const bool clockwise : {false, true}) {
    std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    if (clockwise) square = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    EXPECT_TRUE(contains(square.data(), 4, {0.5, 0.5}));
    EXPECT_TRUE(contains(square.data(), 4, {0.001, 0.999}));
    for (const Vec2 out : {Vec2{1.5, 0.5}, Vec2{-0.5, 0.5}, Vec2{0.5, 1.5}, Vec2{0.5, -0.5}, Vec2{-1, 1}}) {
      EXPECT_FALSE(contains(square.data(), 4, out)) << out.x << ' ' << out.y;
    }
  }
}

TEST(Contains, ANotchIsOutside) {
  const std::vector<Vec2> notched{{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  EXPECT_FALSE(contains(notched.data(), notched.size(), {2, 2}));
  EXPECT_TRUE(contains(notched.data(), notched.size(), {2, 0.5}));
  EXPECT_TRUE(contains(notched.data(), notched.size(), {0.5, 2}));
  EXPECT_TRUE(contains(notched.data(), notched.size(), {3.5, 2}));
}

TEST(Contains, AgreesWithTheWindingAngle) {
  EXPECT_TRUE(rc::check([] {
    // Star-shaped around the origin: any radii at increasing angles.
    const int n = *rc::gen::inRange(3, 12);
    std::vector<Vec2> polygon;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * 3.14159265358979 * i / n, radius = real(0.2, 2);
      polygon.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    const Vec2 p = point(2.5);
    double turned = 0, nearest = 1e9;
    for (int i = 0; i < n; ++i) {
      const Vec2 a = polygon[static_cast<std::size_t>(i)] - p;
      const Vec2 b = polygon[static_cast<std::size_t>((i + 1) % n)] - p;
      turned += std::atan2(cross(a, b), dot(a, b));
      nearest = std::fmin(nearest, distance({0, 0}, {a, b}));
    }
    RC_PRE(nearest > 1e-9);
    RC_ASSERT(contains(polygon.data(), polygon.size(), p) == (std::fabs(turned) > 1));
  }));
}

}  // namespace
}  // namespace whisker::sim
