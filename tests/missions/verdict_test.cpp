#include "host/harness/run/verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "firmware/planning/goal_planner.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/worlds/generate.hpp"
#include "tests/effort.hpp"

namespace whisker {
namespace {

RunResult drive(const Scenario& scenario, std::vector<TickRecord>* records = nullptr,
                PlannerKind planner = PlannerKind::boundary) {
  RunOptions options;
  options.planner = planner;
  if (records != nullptr)
    options.watch = [records](const Moment& moment) { records->push_back(moment.record); };
  return run(scenario, options);
}

/// Six metres straight ahead, with this scale error of the wheels.
Scenario ahead(double wheel_scale_sigma) {
  Scenario s;
  s.goal.at = {6, 0};
  s.noise.wheel_scale_sigma = wheel_scale_sigma;
  return s;
}

TEST(Judged, OnlyReachedDependsOnThePlace) {
  EXPECT_EQ(judged(Verdict::reached, 0.05, 0.1), Verdict::reached);
  EXPECT_EQ(judged(Verdict::reached, 0.2, 0.1), Verdict::off_goal);
  for (const Verdict said : {Verdict::unreachable, Verdict::gave_up, Verdict::contact, Verdict::fault}) {
    EXPECT_EQ(judged(said, 0.2, 0.1), said);
    EXPECT_EQ(judged(said, 0, 0.1), said);
  }
}

TEST(Judged, TheToleranceItselfIsThereAndAMicrometreMoreIsNot) {
  EXPECT_TRUE(at_goal(0.1, 0.1));
  EXPECT_TRUE(at_goal(std::nextafter(0.1, 1), 0.1));
  EXPECT_TRUE(at_goal(0.3, 0.1 + 0.2));
  EXPECT_TRUE(at_goal(0.1 + 0.2, 0.3)) << "0.30000000000000004";
  EXPECT_TRUE(at_goal(0.1000004, 0.1)) << "printed as 0.1";
  EXPECT_FALSE(at_goal(0.1000006, 0.1)) << "printed as 0.100001";
  EXPECT_TRUE(at_goal(0.03333336, 0.03333336));
  EXPECT_FALSE(at_goal(1e6, 1000));
}

TEST(Verdicts, ARobotThatBelievesToBeThereIsOffTheGoal) {
  std::vector<TickRecord> records;
  const Scenario s = ahead(0.02);
  const RunResult r = drive(s, &records);
  ASSERT_EQ(r.verdict, Verdict::off_goal);
  EXPECT_EQ(r.detail, "at_goal_by_its_estimate");
  EXPECT_GT(r.final_distance_m, s.goal.tolerance_m);
  ASSERT_TRUE(r.believed_distance_m);
  EXPECT_LE(*r.believed_distance_m, s.goal.tolerance_m);
  const TickRecord& last = records.back();
  EXPECT_EQ(last.mode, planning::Mode::arrived) << "the robot itself knows of nothing";
  EXPECT_NEAR(*r.believed_distance_m, std::hypot(last.est_x_m - 6, last.est_y_m), 1e-9);
  EXPECT_NEAR(r.final_distance_m, std::hypot(last.x_m - 6, last.y_m), 1e-9);
}

TEST(Verdicts, TheToleranceDecidesAndNothingElse) {
  Scenario s = ahead(0.02);
  const double off = drive(s).final_distance_m;
  s.goal.tolerance_m = 2 * off;
  EXPECT_EQ(drive(s).verdict, Verdict::reached) << "of the same wheels";
  EXPECT_EQ(drive(ahead(0)).verdict, Verdict::reached) << "of ideal ones";
}

// The robot reserves an eighth of the tolerance for the error of its estimate, which ideal wheels never use.
TEST(Verdicts, IdealWheelsAreNeverOffTheGoal) {
  double worst = 0;
  for (const worlds::Kind kind : worlds::kKinds) {
    for (std::uint64_t seed = 1; seed <= test::effort(3); ++seed) {
      worlds::Options options;
      options.seed = seed;
      Scenario s = worlds::generate(kind, options);
      s.noise.range_sigma_m = 0.01;
      s.time_limit_s = 300;
      for (const PlannerKind planner : {PlannerKind::boundary, PlannerKind::thesis, PlannerKind::map}) {
        const RunResult r = drive(s, nullptr, planner);
        EXPECT_NE(r.verdict, Verdict::off_goal)
            << s.name << ", " << name(planner) << ": " << r.final_distance_m;
        if (r.verdict == Verdict::reached) worst = std::fmax(worst, r.final_distance_m / s.goal.tolerance_m);
      }
    }
  }
  EXPECT_GT(worst, 0.4) << "of the tolerance: else this has tested nothing";
  EXPECT_LT(worst, 0.95);
}

// A tolerance is for the error of the estimate: the body itself ends in the middle, however slow or coarse.
TEST(Verdicts, TheBodyEndsInTheMiddleOfTheGoal) {
  for (const PlannerKind planner : {PlannerKind::boundary, PlannerKind::map}) {
    for (const Speed speed : {100_mm_per_s, 200_mm_per_s, 300_mm_per_s}) {
      for (const int tolerance_mm : {75, 100, 500}) {
        Scenario s = ahead(0);
        s.goal.at = {2, 0.3};
        s.goal.tolerance_m = tolerance_mm / 1000.0;
        s.robot.wheels.max_speed = speed;
        const RunResult r = drive(s, nullptr, planner);
        EXPECT_EQ(r.verdict, Verdict::reached);
        EXPECT_LT(r.final_distance_m, 0.01) << name(planner) << ", " << speed.raw() << ", " << tolerance_mm;
      }
    }
  }
}

// A disc of 0.1 m covers the goal's middle: the body stops where it comes no nearer.
TEST(Verdicts, AGoalWhoseMiddleIsCoveredIsReached) {
  for (const PlannerKind planner : {PlannerKind::boundary, PlannerKind::map}) {
    for (const double y : {0.0, 0.05, 0.2}) {
      Scenario s = ahead(0);
      s.goal = {{2, 0}, 0.5};
      s.discs = {{{2, y}, 0.1}};
      s.time_limit_s = 60;
      const RunResult r = drive(s, nullptr, planner);
      EXPECT_EQ(r.verdict, Verdict::reached) << name(planner) << ", " << y << ": " << r.detail;
    }
  }
}

// By the estimate always, and in truth but for the rounding of the counts over the way.
TEST(Verdicts, TheSmallestToleranceIsKept) {
  int off = 0, drives = 0;
  for (const int counts_per_metre : {5000, 2000, 200, 100}) {
    for (const PlannerKind planner : {PlannerKind::boundary, PlannerKind::thesis, PlannerKind::map}) {
      for (std::uint64_t i = 0; i < test::effort(12); ++i) {
        Scenario s;
        const double at = 2.4 * static_cast<double>(i);
        s.start = {{2 * std::cos(at) + 0.01 * at, 1.3 * std::sin(at)}, at};
        s.time_limit_s = 200;
        s.robot.wheels.counts_per_metre = counts_per_metre;
        s.goal.tolerance_m = planning::smallest_tolerance(s.robot).raw() * 1e-6;
        const RunResult r = drive(s, nullptr, planner);
        EXPECT_TRUE(r.verdict == Verdict::reached || r.verdict == Verdict::off_goal)
            << counts_per_metre << ", " << name(planner) << ", " << i << ": " << r.detail;
        const double beside = 2 * r.path_m / (counts_per_metre * 0.14);
        EXPECT_LE(r.final_distance_m, s.goal.tolerance_m + beside);
        ++drives;
        off += r.verdict == Verdict::off_goal;
        s.goal.tolerance_m -= 1e-6;
        if (i > 0) continue;
        EXPECT_EQ(drive(s, nullptr, planner).detail, "tolerance_too_small");
      }
    }
  }
  EXPECT_LE(off, drives / 24);
}

}  // namespace
}  // namespace whisker
