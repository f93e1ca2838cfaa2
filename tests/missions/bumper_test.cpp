// Missions among obstacles that no beam sees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/harness/run/runner.hpp"
#include "tests/unseen_disc.hpp"

namespace whisker {
namespace {

Scenario unseen(bool bumper) {
  Scenario s = test::unseen_disc();
  s.time_limit_s = 300;
  if (!bumper) s.robot.bumper.fitted = Fitted::no;
  return s;
}

class Bumper : public testing::TestWithParam<PlannerKind> {};

TEST_P(Bumper, FindsTheWayAroundAnObstacleThatNoBeamSees) {
  RunOptions options;
  options.planner = GetParam();
  std::vector<TickRecord> records;
  options.watch = [&](const Moment& moment) { records.push_back(moment.record); };
  const RunResult r = run(unseen(true), options);
  EXPECT_EQ(r.verdict, Verdict::reached);
  EXPECT_GE(r.bumps.value_or(0), 1U);
  EXPECT_LE(r.bumps.value_or(99), 8U);
  EXPECT_GE(r.min_clearance_m, 0);
  for (std::size_t i = 1; i < records.size(); ++i) {
    if (records[i].pressed == 0) continue;
    ASSERT_LE(records[i].command.left + records[i].command.right, 0) << "ahead at " << records[i].t_s << " s";
    const bool fresh = records[i - 1].pressed == 0;
    ASSERT_TRUE(!fresh || records[i].command.left == 0) << "at once, at " << records[i].t_s << " s";
  }
  EXPECT_EQ(run(unseen(false), options).verdict, Verdict::contact);
}

TEST_P(Bumper, AnEnclosureThatNoBeamSeesEndsInAVerdict) {
  Scenario s = unseen(true);
  s.discs.clear();
  s.walls.push_back({{-0.3, -0.3}, {0.5, -0.3}, {0.5, 0.4}, {-0.3, 0.4}, {-0.3, -0.3}});
  s.time_limit_s = 3000;
  s.robot.boundary.length_budget = 10_m;
  RunOptions options;
  options.planner = GetParam();
  const RunResult r = run(s, options);
  EXPECT_TRUE(r.verdict == Verdict::fault || r.verdict == Verdict::gave_up ||
              r.verdict == Verdict::unreachable);
  EXPECT_NE(r.detail, "time_limit");
  std::printf("%s: %s after %.0f s, %u bumps\n", name(GetParam()).c_str(), r.detail.c_str(), r.time_s,
              r.bumps.value_or(0));
}

INSTANTIATE_TEST_SUITE_P(With, Bumper,
                         testing::Values(PlannerKind::boundary, PlannerKind::map, PlannerKind::thesis));

}  // namespace
}  // namespace whisker
