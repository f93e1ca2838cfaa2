#include "host/scenario/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace whisker {
namespace {

using sim::Segment;
using sim::Vec2;
using Points = std::vector<Vec2>;

TEST(Distance, ToASegmentIsToItsNearestPoint) {
  const Segment s{{1, 1}, {4, 5}};
  for (double x = -2; x <= 7; x += 0.37) {
    for (double y = -2; y <= 8; y += 0.41) {
      double nearest = 1e9;
      for (int i = 0; i <= 4000; ++i) {
        nearest = std::min(nearest, distance({x, y}, s.a + (s.b - s.a) * (i / 4000.0)));
      }
      EXPECT_NEAR(distance({x, y}, s), nearest, 1e-3);
      EXPECT_LE(distance({x, y}, s), nearest + 1e-12);
    }
  }
}

TEST(Distance, ToASegmentWithoutLengthIsToItsPoint) {
  EXPECT_EQ(distance({3, 4}, Segment{{0, 0}, {0, 0}}), 5);
}

TEST(Intersect, FindsCrossingsTouchesAndOverlaps) {
  const Segment s{{0, 0}, {4, 0}};
  EXPECT_TRUE(intersect(s, {{2, -1}, {2, 1}}));
  EXPECT_TRUE(intersect(s, {{2, 0}, {2, 1}}));
  EXPECT_TRUE(intersect(s, {{4, 0}, {5, 1}}));
  EXPECT_TRUE(intersect(s, {{3, 0}, {6, 0}}));
  EXPECT_FALSE(intersect(s, {{5, 0}, {6, 0}}));
  EXPECT_FALSE(intersect(s, {{2, 0.001}, {2, 1}}));
  EXPECT_FALSE(intersect(s, {{5, -1}, {5, 1}}));
}

// A simple polygon contains a point if the outline winds around it once.
double winding(Vec2 p, const Points& polygon) {
  double turn = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = edge(polygon, i).a - p;
    const Vec2 b = edge(polygon, i).b - p;
    turn += std::atan2(cross(a, b), dot(a, b));
  }
  return turn / (2 * std::acos(-1));
}

TEST(Inside, AgreesWithTheWindingNumber) {
  const Points comb{{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1},
                    {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  int in = 0;
  for (double x = -0.503; x < 6; x += 0.1) {
    for (double y = -0.507; y < 4; y += 0.1) {
      const bool expected = std::fabs(winding({x, y}, comb)) > 0.5;
      EXPECT_EQ(inside({x, y}, comb), expected) << x << ", " << y;
      in += expected ? 1 : 0;
    }
  }
  EXPECT_GT(in, 1000);
}

TEST(SignedArea, IsPositiveForCounterClockwisePoints) {
  EXPECT_EQ(signed_area({{1, 1}, {3, 1}, {3, 2}, {1, 2}}), 2);
  EXPECT_EQ(signed_area({{1, 2}, {3, 2}, {3, 1}, {1, 1}}), -2);
}

TEST(CrossingEdges, AreFoundInAStarAndNotInACircleOfAnySize) {
  for (const int n : {5, 7, 101, 4096}) {
    for (const int step : {1, 2}) {
      if (n % 2 == 0 && step == 2) continue;
      Points points;
      for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::acos(-1) * i * step / n;
        points.push_back({std::cos(angle), std::sin(angle)});
      }
      EXPECT_EQ(crossing_edges(points).has_value(), step == 2) << n;
    }
  }
}

}  // namespace
}  // namespace whisker
