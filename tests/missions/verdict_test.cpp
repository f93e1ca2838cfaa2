#include "host/run/verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "host/run/runner.hpp"
#include "host/worlds/generate.hpp"
#include "tests/effort.hpp"

namespace whisker {
namespace {

RunResult drive(const Scenario& scenario, std::vector<TickRecord>* records = nullptr,
                PlannerKind planner = PlannerKind::skirt) {
  RunOptions options;
  options.planner = planner;
  options.records = records;
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
      for (const PlannerKind planner : {PlannerKind::skirt, PlannerKind::thesis, PlannerKind::map}) {
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

}  // namespace
}  // namespace whisker
