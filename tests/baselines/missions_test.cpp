// Missions of the baseline planners: each shows its algorithm's guarantees, and none has a contact.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "host/harness/run/runner.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/worlds/generate.hpp"
#include "tests/effort.hpp"

namespace whisker {
namespace {

const PlannerKind kBug2 = *planner_named("bug2");
const PlannerKind kDistBug = *planner_named("distbug");
const PlannerKind kWallFollower = *planner_named("wall-follower");
const PlannerKind kFan = *planner_named("fan");
const PlannerKind kRepulsion = *planner_named("repulsion");
const PlannerKind kAll[] = {kBug2, kDistBug, kWallFollower, kFan, kRepulsion};

struct Drive {
  RunResult result;
  std::vector<TickRecord> records;
};

Drive drive(const Scenario& scenario, PlannerKind planner) {
  Drive d;
  RunOptions options;
  options.planner = planner;
  options.watch = [&](const Moment& moment) { d.records.push_back(moment.record); };
  d.result = run(scenario, options);
  return d;
}

Scenario three_metres(const std::string& obstacles) {
  return parse_scenario("[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 3.0\ny_m = 0.0\n" + obstacles,
                        "three_metres.toml");
}

const std::string kDisc = "[[disc]]\ncenter = [1.5, 0.05]\nradius_m = 0.4\n";
const std::string kFence = "[[polygon]]\npoints = [[2.5, -0.5], [3.5, -0.5], [3.5, 0.5], [2.5, 0.5]]\n";
const std::string kPen =
    "[[wall]]\npoints = [[-0.6, -0.6], [0.6, -0.6], [0.6, 0.6], [-0.6, 0.6], [-0.6, -0.6]]\n";

/// The leftmost and the rightmost position, m from the x axis.
struct Sides {
  double left_m = -std::numeric_limits<double>::infinity();
  double right_m = std::numeric_limits<double>::infinity();
};

Sides sides(const Drive& d) {
  Sides s;
  for (const TickRecord& r : d.records) {
    s.left_m = std::fmax(s.left_m, r.y_m);
    s.right_m = std::fmin(s.right_m, r.y_m);
  }
  return s;
}

class Baseline : public testing::TestWithParam<PlannerKind> {};

TEST_P(Baseline, CrossesAnEmptyWorldStraight) {
  const Drive d = drive(three_metres(""), GetParam());
  EXPECT_EQ(d.result.verdict, Verdict::reached);
  EXPECT_LT(d.result.path_m, 3.05);
}

TEST_P(Baseline, GoesRoundADisc) {
  const Drive d = drive(three_metres(kDisc), GetParam());
  EXPECT_EQ(d.result.verdict, Verdict::reached);
  EXPECT_GT(d.result.min_clearance_m, 0);
  EXPECT_LT(d.result.path_m, 5);
}

TEST_P(Baseline, TouchesNothingInAnyClassOfWorld) {
  for (const worlds::Kind kind : worlds::kKinds) {
    for (std::uint64_t seed = 1; seed <= test::effort(8); ++seed) {
      worlds::Options options;
      options.seed = seed;
      Scenario s = worlds::generate(kind, options);
      s.time_limit_s = 45;
      RunOptions run_options;
      run_options.planner = GetParam();
      const RunResult r = run(s, run_options);
      EXPECT_NE(r.verdict, Verdict::contact) << s.name;
      EXPECT_NE(r.verdict, Verdict::fault) << s.name << ": " << r.detail;
    }
  }
}

TEST_P(Baseline, StandsWhereItStartsIfThatIsTheGoal) {
  Scenario s = three_metres("");
  s.goal.at = s.start.at;
  const RunResult r = drive(s, GetParam()).result;
  EXPECT_EQ(r.verdict, Verdict::reached);
  EXPECT_LT(r.path_m, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Each, Baseline, testing::ValuesIn(kAll), [](const auto& each) {
  std::string word = name(each.param);
  for (char& c : word) c = c == '-' ? '_' : c;
  return word;
});

TEST(Bug2, LeavesTheMLineOnlyRoundTheObstacleAndToTheLeft) {
  const Drive d = drive(three_metres(kDisc), kBug2);
  ASSERT_EQ(d.result.verdict, Verdict::reached);
  for (const TickRecord& r : d.records) {
    if (r.mode == planning::Mode::going && (r.x_m < 0.9 || r.x_m > 2.5)) {
      EXPECT_NEAR(r.y_m, 0, 0.05) << r.t_s;
    }
  }
  EXPECT_GT(sides(d).left_m, 0.45);
  EXPECT_GT(sides(d).right_m, -0.2);
}

TEST(Bug2, LeavesAtTheMLineAndNotAtTheFirstFreeViewOfTheGoal) {
  // Beyond the wall's end the goal is visible at once; the m-line is not reached yet.
  const Scenario s = three_metres("[[wall]]\npoints = [[1.2, -1.5], [1.2, 0.8]]\n");
  const Drive d = drive(s, kBug2);
  ASSERT_EQ(d.result.verdict, Verdict::reached);
  double leaves_at_y_m = 1;
  for (std::size_t i = 1; i < d.records.size(); ++i) {
    const bool left =
        d.records[i - 1].mode != planning::Mode::going && d.records[i].mode == planning::Mode::going;
    if (left && d.records[i].x_m > 1.2) leaves_at_y_m = d.records[i].y_m;
  }
  EXPECT_NEAR(leaves_at_y_m, 0, 0.06);
}

TEST(DistBug, LeavesAsSoonAsTheGoalIsFreeAndNearer) {
  const Scenario s = three_metres("[[wall]]\npoints = [[1.1, -1.5], [1.3, 0.8]]\n");
  const Drive dist = drive(s, kDistBug);
  const Drive bug2 = drive(s, kBug2);
  ASSERT_EQ(dist.result.verdict, Verdict::reached);
  EXPECT_LT(dist.result.path_m, bug2.result.path_m - 0.2);
}

TEST(DistBug, TurnsToTheSideThatSeesFarther) {
  const std::string shelf = "[[wall]]\npoints = [[1.3, 0.9], [1.1, -0.9], [0.3, -0.9]]\n";
  EXPECT_LT(sides(drive(three_metres(shelf), kDistBug)).right_m, 0.1);
  EXPECT_GT(sides(drive(three_metres(shelf), kDistBug)).left_m, 0.9);
}

TEST(WallFollower, KeepsItsLeftHandOnTheWall) {
  const Drive d = drive(three_metres(kDisc), kWallFollower);
  ASSERT_EQ(d.result.verdict, Verdict::reached);
  EXPECT_LT(sides(d).right_m, -0.4);
  EXPECT_LT(sides(d).left_m, 0.1);
}

TEST(Unreachable, IsToldByThoseWhoRememberWhereTheyHit) {
  for (const PlannerKind kind : {kBug2, kDistBug, kFan, kRepulsion}) {
    for (const std::string& around : {kFence, kPen}) {
      const RunResult r = drive(three_metres(around), kind).result;
      EXPECT_EQ(r.verdict, Verdict::unreachable) << name(kind) << around;
      EXPECT_GT(r.min_clearance_m, 0);
    }
  }
}

TEST(Unreachable, IsNotToldByTheWallFollowerWhichGivesUpWithinItsLength) {
  Scenario s = three_metres(kPen);
  s.time_limit_s = 20000;
  const RunResult r = drive(s, kWallFollower).result;
  EXPECT_EQ(r.verdict, Verdict::gave_up);
  EXPECT_EQ(r.detail, "length_budget");
  EXPECT_NEAR(r.path_m, 400, 8);
}

}  // namespace
}  // namespace whisker
