#include "host/harness/scenario/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/scenario/contact.hpp"

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

Scenario one_of_each() {
  Scenario s;
  s.bounds = Bounds{{-10, -10}, {10, 10}};
  s.discs = {{{-5, 0}, 1}};
  s.polygons = {{{4, -1}, {6, -1}, {6, 1}, {4, 1}}};
  s.walls = {{{-1, 5}, {1, 5}, {1, 7}}};
  s.movers = {{{0, -5}, 0.5, {{-2, -5}, {2, -5}}, 0.1}};
  return s;
}

struct Case {
  sim::Vec2 point;
  double distance_m;
  const char* what;
};

TEST(NearestObstacle, IsNamedAndMeasured) {
  const Scenario s = one_of_each();
  const Case cases[] = {
      {{-3, 0}, 1, "disc 1"},          {{-5, 0.2}, -0.8, "disc 1"},         {{3.5, 0}, 0.5, "polygon 1"},
      {{4.25, 0}, -0.25, "polygon 1"}, {{7, 2}, std::sqrt(2), "polygon 1"}, {{0, 4.5}, 0.5, "wall 1"},
      {{1.5, 6}, 0.5, "wall 1"},       {{0, -4}, 0.5, "mover 1"},           {{9.75, 9}, 0.25, "the bounds"},
      {{0, -11}, -1, "the bounds"}};
  for (const Case& c : cases) {
    const Nearest nearest = nearest_obstacle(s, c.point);
    EXPECT_NEAR(nearest.distance_m, c.distance_m, 1e-12) << c.point.x << ", " << c.point.y;
    EXPECT_EQ(nearest.what, c.what) << c.point.x << ", " << c.point.y;
  }
}

TEST(NearestObstacle, OfAnEmptyWorldIsInfinitelyFar) {
  EXPECT_TRUE(std::isinf(nearest_obstacle(Scenario{}, {0, 0}).distance_m));
}

TEST(StartFault, DependsOnTheBodysRadius) {
  Scenario s = one_of_each();
  s.start.at = {-3.8, 0};
  EXPECT_EQ(start_fault(s), "");
  s.robot.body.radius = 201_mm;
  EXPECT_EQ(start_fault(s),
            "the start is in contact with disc 1: it is 0.2000 m away, and the body's radius is 0.201 m");
}

TEST(Bearing, AgreesWithTheLibraryAllAround) {
  for (int i = -3600; i <= 3600; ++i) {
    const double angle = i * (3.14159265358979 / 3600);
    for (const double radius : {1e-4, 1.0, 11.3, 2800.0}) {
      const sim::Vec2 to{radius * std::cos(angle), radius * std::sin(angle)};
      EXPECT_NEAR(bearing({0, 0}, to), std::atan2(to.y, to.x), 1e-15) << i;
    }
  }
}

TEST(Bearing, IsExactOnTheAxes) {
  const double pi = std::acos(-1);
  EXPECT_EQ(bearing({1, 1}, {5, 1}), 0);
  EXPECT_EQ(bearing({1, 1}, {1, 5}), pi / 2);
  EXPECT_EQ(bearing({1, 1}, {-5, 1}), pi);
  EXPECT_EQ(bearing({1, 1}, {1, -5}), -pi / 2);
}

TEST(Bearing, OfNoWayAtAllIsZero) { EXPECT_EQ(bearing({2, 3}, {2, 3}), 0); }

}  // namespace
}  // namespace whisker
