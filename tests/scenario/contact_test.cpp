#include "host/scenario/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace whisker {
namespace {

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

}  // namespace
}  // namespace whisker
