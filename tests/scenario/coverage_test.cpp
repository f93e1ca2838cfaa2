// Walls and ground that the cones cover, against an independent count of rays and points.
#include "host/harness/scenario/coverage.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/lab/campaign/random_robot.hpp"
#include "tests/scenario/temporary_file.hpp"

namespace whisker {
namespace {

constexpr double kRad = 3.14159265358979323846 / 180;

Params robot(const std::string& keys) {
  const TemporaryFile file(keys);
  Params params;
  apply_robot_file(params, file.path());
  return params;
}

TEST(Walls, TheReferenceRobotNeedsSensorsThatSeeThemUpTo47Degrees) {
  EXPECT_NEAR(outer_edge_deg({}, {}, true), 42.5, 1e-6);
  EXPECT_NEAR(needed_incidence_deg({}, {}), 47.5, 1e-6);
  EXPECT_EQ(seen_incidence_deg({}, {}), 90);
}

TEST(Walls, AConeCountsAsWideAsItIsWhereReadingsClearGround) {
  Params params;
  params.rangefinders.cone = 40_deg;
  Sensor sensor;
  sensor.cone_deg = 40;
  sensor.cone_far_deg = 20;
  sensor.max_range_m = 4;
  params.rangefinders.clear_range = 1_m;
  EXPECT_NEAR(outer_edge_deg(params, sensor, true), 30 + 35 / 2.0, 1e-6);
  params.rangefinders.cone = 30_deg;
  EXPECT_NEAR(outer_edge_deg(params, sensor, true), 30 + 15, 1e-6) << "believed to be narrower";
}

TEST(Walls, TheSideThatReachesLessFarCounts) {
  const Params p =
      robot("range_left_angle_deg = 50\nrange_right_angle_deg = -40\nrange_right_cone_deg = 10\n");
  EXPECT_NEAR(outer_edge_deg(p, {}, true), 62.5, 1e-6);
  EXPECT_NEAR(outer_edge_deg(p, {}, false), 45, 1e-6);
  EXPECT_NEAR(needed_incidence_deg(p, {}), 45, 1e-6);
}

TEST(Walls, ATrueConeCountsWhereItIsNarrower) {
  Sensor sensor;
  sensor.cone_deg = 40;
  EXPECT_NEAR(needed_incidence_deg({}, sensor), 47.5, 1e-6);
  sensor.cone_far_deg = 15;
  EXPECT_NEAR(needed_incidence_deg({}, sensor), 52.5, 1e-6);
}

TEST(Walls, TheSmallerIncidenceCounts) {
  Sensor sensor;
  sensor.incidence_deg = 55;
  EXPECT_NEAR(seen_incidence_deg(robot("range_incidence_deg = 60\n"), sensor), 55, 1e-6);
  EXPECT_NEAR(seen_incidence_deg(robot("range_incidence_deg = 50\n"), sensor), 50, 1e-6);
}

/// The least angle between a wall's normal, at `normal` degrees from straight ahead, and a ray of the cones.
double least_incidence(const Params& p, double normal) {
  double least = 180;
  for (int beam = 0; beam < 3; ++beam) {
    const Mount m = mount(p.rangefinders, beam);
    const double axis = m.axis.wrapped() * (180.0 / 2147483648.0);
    const double half = m.half_cone.wrapped() * (180.0 / 2147483648.0);
    for (int i = 0; i <= 100; ++i) least = std::fmin(least, std::fabs(axis + half * (i / 50.0 - 1) - normal));
  }
  return least;
}

TEST(Walls, TheNeededIncidenceIsThatOfTheWorstWallAhead) {
  for (const char* keys :
       {"range_side_angle_deg = 20\n", "", "range_side_angle_deg = 42.5\n", "range_side_angle_deg = 60\n",
        "range_side_angle_deg = 75\nrange_cone_deg = 12\n",
        "range_side_angle_deg = 70\nrange_cone_deg = 14\n",
        "range_left_angle_deg = 60\nrange_front_angle_deg = -20\nrange_right_angle_deg = -50\n"}) {
    const Params p = robot(keys);
    double worst = 0;
    for (double normal = -90; normal <= 90; normal += 0.5)
      worst = std::fmax(worst, least_incidence(p, normal));
    EXPECT_NEAR(needed_incidence_deg(p, {}), worst, 0.3) << keys;
  }
}

/// Whether a point is in some cone, by its bearing.
bool in_a_cone(const Params& p, double x, double y) {
  for (int beam = 0; beam < 3; ++beam) {
    const Mount m = mount(p.rangefinders, beam);
    const double dx = x - m.apex.x.raw() * 1e-6, dy = y - m.apex.y.raw() * 1e-6;
    const double axis = m.axis.wrapped() * (180.0 / 2147483648.0);
    const double half = m.half_cone.wrapped() * (180.0 / 2147483648.0);
    const double reach = proving_range(p.rangefinders).raw() * 1e-6;
    if (std::hypot(dx, dy) <= reach && std::fabs(std::atan2(dy, dx) / kRad - axis) <= half) return true;
  }
  return false;
}

/// The width of the widest strip on one side, from points 1/250 of the radius apart.
double counted(const Params& p, double side) {
  const double radius = p.body.radius.raw() * 1e-6, swept = reach(p).guard.raw() * 1e-6, step = radius / 250;
  const double window = 18 * grid_cell(p).raw() * 1e-6, ahead = seen_ahead_m(p);
  double widest = 0, now = 0;
  for (double y = step / 2; y < swept; y += step) {
    const double from = std::fmin(std::sqrt(swept * swept - y * y) + ahead, window);
    bool seen = false;
    for (int i = 0; i <= 500 && !seen; ++i) seen = in_a_cone(p, from + (window - from) * i / 500, side * y);
    now = seen ? 0 : now + step;
    widest = std::fmax(widest, now);
  }
  return widest;
}

TEST(UnseenStrip, IsTheOneThatPointsShow) {
  int some = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Params p = campaign::random_robot(seed).params;
    const Strip strip = unseen_strip(p, {});
    const double radius = p.body.radius.raw() * 1e-6;
    EXPECT_NEAR(strip.width(), std::fmax(counted(p, 1), counted(p, -1)), 0.014 * radius) << seed;
    EXPECT_GE(strip.inner_m, 0);
    some += hides_obstacles(strip, p) ? 1 : 0;
  }
  EXPECT_GT(some, 5);
  EXPECT_LT(some, 30);
}

TEST(UnseenStrip, ThereIsNoneForTheReferenceRobotAndItsWiderLayouts) {
  for (const char* keys : {"", "range_side_angle_deg = 37.5\n", "range_side_angle_deg = 42.5\n"}) {
    const Params p = robot(keys);
    EXPECT_FALSE(hides_obstacles(unseen_strip(p, {}), p)) << keys;
  }
}

TEST(UnseenStrip, GrowsWithTheSideAngleAndShrinksWithTheCone) {
  const auto width = [](const char* keys) { return unseen_strip(robot(keys), {}).width(); };
  const double narrow = width("range_cone_deg = 15\n");
  EXPECT_GT(narrow, 0.010);
  EXPECT_GT(width("range_cone_deg = 15\nrange_side_angle_deg = 45\n"), narrow + 0.010);
  EXPECT_GT(width("range_cone_deg = 10\n"), narrow + 0.010);
  Sensor sensor;
  sensor.cone_deg = 15;
  EXPECT_NEAR(unseen_strip({}, sensor).width(), narrow, 1e-3) << "a true cone counts as a believed one";
}

}  // namespace
}  // namespace whisker
