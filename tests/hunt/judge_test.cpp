#include "host/lab/hunt/judge.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/harness/run/runner.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/lab/guard/drive.hpp"
#include "host/lab/hunt/dice.hpp"
#include "host/lab/hunt/draw.hpp"
#include "host/lab/hunt/geometry.hpp"
#include "host/lab/hunt/trial.hpp"

namespace whisker::hunt {
namespace {

Scenario post_ahead() {
  Scenario s;
  s.goal.at = {3, 0};
  s.sensor.corner_scatter_m = 1000;
  s.discs = {{{1, 0}, 0.001}};
  return s;
}

TEST(Nearest, AgreesWithTheSimulator) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Scenario s = draw_case(seed).c.scenario;
    const SimWorld world(s);
    Dice dice(seed);
    for (int i = 0; i < 20; ++i) {
      const sim::Vec2 at = dice.around(s.start.at, 0.01, 3);
      const double distance = nearest(s, at).distance_m, there = sim::clearance(world.view(), at, 0, 0);
      // The simulator does not know the inside of polygons and bounds.
      if (distance < 0) continue;
      EXPECT_NEAR(distance, there, 1e-9) << seed;
      if (!std::isfinite(distance)) continue;
      EXPECT_NEAR(length(nearest(s, at).at - at), distance, 1e-9) << seed;
    }
  }
}

TEST(Nearest, IsNegativeInsideSolids) {
  Scenario s;
  s.polygons = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  EXPECT_NEAR(nearest(s, {0.5, 0.75}).distance_m, -0.25, 1e-12);
  s.polygons.clear();
  s.bounds = Bounds{{0, 0}, {1, 1}};
  EXPECT_NEAR(nearest(s, {1.5, 0.5}).distance_m, -0.5, 1e-12);
  EXPECT_NEAR(nearest(s, {0.5, 0.4}).distance_m, 0.4, 1e-12);
}

TEST(Judge, SeesWhatTheBodyPassedBetweenTwoTicks) {
  const Scenario s = post_ahead();
  Judge judge(s);
  judge.see({{0.5, 0}, 0}, 0.01);
  EXPECT_FALSE(judge.touched());
  judge.see({{1.6, 0.02}, 0}, 0.02);
  EXPECT_TRUE(judge.touched());
}

TEST(Judge, MeasuresTheGapBeyondTheMargin) {
  const Scenario s = post_ahead();
  Judge judge(s);
  judge.see({{0.905, 0}, 0}, 1);
  EXPECT_FALSE(judge.touched());
  EXPECT_NEAR(judge.gap_m(), 0.004, 1e-5);
  EXPECT_NEAR(judge.closeness(), 0, 1e-3);
  judge.see({{0.907, 0}, 0}, 2);
  EXPECT_NEAR(judge.closeness(), -0.002 / 0.09, 1e-3);
  EXPECT_FALSE(judge.touched());
}

TEST(Judge, KnowsRest) {
  const Scenario s = post_ahead();
  Judge judge(s);
  judge.see({{0.1, 0}, 0}, 5);
  EXPECT_FALSE(judge.rests(34));
  EXPECT_TRUE(judge.rests(36));
  judge.see({{0.1, 0}, 0.2}, 36);
  EXPECT_FALSE(judge.rests(37));
}

TEST(HasWay, TakesDoorsThatAreWideEnough) {
  Scenario s;
  s.start.at = {0, 0};
  s.goal = {{2, 0}, 0.1};
  s.bounds = Bounds{{-1, -1}, {3, 1}};
  s.walls = {{{1, -1}, {1, -0.15}}, {{1, 0.15}, {1, 1}}};
  EXPECT_TRUE(has_way(s, 0.12));
  EXPECT_FALSE(has_way(s, 0.16));
}

TEST(Attempt, GivesTheHashesOfRunAndGuard) {
  int missions = 0, drives = 0;
  for (std::uint64_t seed = 1; missions < 6 || drives < 6; ++seed) {
    Case c = draw_case(seed).c;
    if (c.gaps != 0 || count_shapes(c.scenario) > 100) continue;
    c.scenario.time_limit_s = std::min(c.scenario.time_limit_s, 10.0);
    const Outcome outcome = attempt(c);
    if (c.planner) {
      RunOptions options;
      options.planner = *c.planner;
      EXPECT_EQ(run(c.scenario, options).hash, outcome.hash) << seed;
      ++missions;
      continue;
    }
    // The commands of the attacker are recorded now.
    guard::Recorded recorded(c.commands);
    guard::Options options;
    options.time_s = c.scenario.time_limit_s;
    options.until_goal = false;
    EXPECT_EQ(guard::drive(c.scenario, recorded, options).hash, outcome.hash) << seed;
    EXPECT_EQ(attempt(c).hash, outcome.hash) << seed;
    ++drives;
  }
}

/// Sensors that lose walls beyond 30 degrees, of a robot that believes in 90.
TEST(Attempt, FindsTheContactsOfRobotsOutsideThePremise) {
  int contacts = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Case c = draw_case(seed).c;
    c.scenario.robot = {};
    if (nearest(c.scenario, c.scenario.start.at).distance_m < 0.1) continue;
    c.planner = PlannerKind::boundary;
    c.scenario.sensor.incidence_deg = 10;
    c.scenario.time_limit_s = 60;
    c.gaps = 0;
    const Outcome outcome = attempt(c);
    EXPECT_NE(outcome.finding, "judges_disagree") << seed;
    if (outcome.finding == "contact") ++contacts;
  }
  EXPECT_GT(contacts, 0);
}

}  // namespace
}  // namespace whisker::hunt
