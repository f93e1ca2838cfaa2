#include "host/harness/run/runner.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "host/harness/scenario/load.hpp"
#include "host/harness/worlds/generate.hpp"
#include "tests/effort.hpp"
#include "tests/missions/judge.hpp"

namespace whisker {
namespace {

const std::filesystem::path kScenarios = std::filesystem::path(WHISKER_SOURCE_DIR) / "host/worlds/scenarios";

struct Drive {
  RunResult result;
  std::vector<TickRecord> records;
  std::string complaint;
};

Drive drive(const Scenario& scenario, PlannerKind planner = PlannerKind::boundary) {
  Drive d;
  RunOptions options;
  options.planner = planner;
  options.watch = [&](const Moment& moment) { d.records.push_back(moment.record); };
  d.result = run(scenario, options);
  d.complaint = test::judge(scenario, d.records, d.result).complaint;
  return d;
}

Scenario small_world(const std::string& obstacles) {
  return parse_scenario(R"(
    name = "small"
    time_limit_s = 120.0
    [start]
    x_m = 0.0
    y_m = 0.0
    [goal]
    x_m = 2.0
    y_m = 0.0
)" + obstacles,
                        "small.toml");
}

TEST(Run, AnEmptyWorldIsCrossedStraight) {
  const Drive d = drive(small_world(""));
  EXPECT_EQ(d.result.verdict, Verdict::reached);
  EXPECT_EQ(d.complaint, "");
  EXPECT_NEAR(d.result.path_m, 2.0, 0.1);
  EXPECT_LT(d.result.final_distance_m, 0.1);
  EXPECT_EQ(d.records.size(), d.result.ticks);
}

Drive through_door(double width, sim::Pose start, PlannerKind planner) {
  Scenario s = small_world("");
  s.start = start;
  s.goal.at = {4, 0};
  s.bounds = Bounds{{-1, -2}, {5, 2}};
  for (const double side : {1.0, -1.0}) {
    s.polygons.push_back({{2, side * width / 2}, {2.1, side * width / 2}, {2.1, side * 2}, {2, side * 2}});
    if (side < 0) std::reverse(s.polygons.back().begin(), s.polygons.back().end());
  }
  return drive(s, planner);
}

/// The mean times of 10 drives through each of 20 doors, as multiples of those over free ground.
struct ThroughDoors {
  double all = 0;     ///< from 1.6 to 3 bodies
  double narrow = 0;  ///< from 1.65 to 1.75
  double wide = 0;    ///< from 1.75
};

ThroughDoors through_doors(PlannerKind planner) {
  constexpr int kWidths = 20, kStarts = 10;
  constexpr double kOpen = 4;
  ThroughDoors mean;
  int narrow = 0, wide = 0;
  for (int start = 0; start < kStarts; ++start) {
    const sim::Pose from{{0, 0.011 * (start - 4.5)}, 0.035 * (start * 7 % kStarts - 4.5)};
    const double free_s = through_door(kOpen, from, planner).result.time_s;
    for (int i = 0; i < kWidths; ++i) {
      const double bodies = 1.6 + 1.4 * i / (kWidths - 1);
      const Drive d = through_door(0.18 * bodies, from, planner);
      const bool promised = i > 0;
      EXPECT_TRUE(d.result.verdict == Verdict::reached || !promised) << bodies << " bodies, start " << start;
      EXPECT_EQ(d.complaint, "");
      const double ratio = d.result.time_s / free_s;
      mean.all += ratio / (kWidths * kStarts);
      if (bodies >= 1.75) {
        ++wide;
        mean.wide += ratio;
      } else if (bodies >= 1.65) {
        ++narrow;
        mean.narrow += ratio;
      }
    }
  }
  mean.narrow /= narrow;
  mean.wide /= wide;
  std::printf("%s: 1.65 to 1.75 bodies %.2f, from 1.75 %.2f, all %.2f times free ground\n",
              name(planner).c_str(), mean.narrow, mean.wide, mean.all);
  return mean;
}

/// From the start, a cone covers the door and its posts: the map suspects the door until the body is near.
/// Below 1.75 bodies it looks closed to the local grid, too: the robot measures its jambs.
TEST(Run, ADoorIsPassedAtTheFirstApproach) {
  const ThroughDoors boundary = through_doors(PlannerKind::boundary), map = through_doors(PlannerKind::map);
  for (const ThroughDoors& mean : {boundary, map}) {
    EXPECT_LT(mean.narrow, 3);
    EXPECT_LT(mean.wide, 1.5);
  }
  EXPECT_LT(map.all / boundary.all, 1.2);
}

TEST(Run, ADoorInAWallIsPassedFromAside) {
  // The boundary planner has no map to tell the door from the wall. The wall beside the slit tells it.
  const Drive d = through_door(0.315, {{0, 0.0215}, -0.1407}, PlannerKind::boundary);
  EXPECT_EQ(d.result.verdict, Verdict::reached);
  EXPECT_LT(d.result.path_m, 5);
}

TEST(Run, AFixIsTrueAtTheCountsOfItsTick) {
  Scenario scenario = small_world("");
  scenario.noise.fix_every_m = 0.6;
  for (const int ppm : {0, 1000}) {
    scenario.robot.pose_error.wheel_scale = millionths(ppm);
    const Drive d = drive(scenario);
    EXPECT_EQ(d.result.verdict, Verdict::reached);
    EXPECT_NEAR(d.result.believed_distance_m.value_or(0), d.result.final_distance_m, 0.0005)
        << "at full speed, a period of the way is 3 mm";
  }
}

TEST(Run, TheTimeLimitIsGaveUpAndSaysSo) {
  Scenario s = small_world("");
  s.time_limit_s = 1.0;
  const Drive d = drive(s);
  EXPECT_EQ(d.result.verdict, Verdict::gave_up);
  EXPECT_EQ(d.result.detail, "time_limit");
  EXPECT_EQ(d.result.ticks, 101U);
}

TEST(Run, AWallWithoutEndMakesTheThesisPlannerGiveUp) {
  Scenario s = small_world("[[wall]]\npoints = [[1.0, -9.0], [1.0, 9.0]]\n");
  s.robot.boundary.length_budget = 6_m;
  s.time_limit_s = 600;
  const Drive d = drive(s, PlannerKind::thesis);
  EXPECT_EQ(d.result.verdict, Verdict::gave_up);
  EXPECT_EQ(d.result.detail, "step_budget");
  EXPECT_EQ(d.complaint, "");
}

TEST(Run, TheLengthBudgetIsTheRobots) {
  for (const PlannerKind planner : {PlannerKind::boundary, PlannerKind::map}) {
    Scenario s = small_world("");
    s.robot.boundary.length_budget = 1_m;
    const Drive d = drive(s, planner);
    EXPECT_EQ(d.result.verdict, Verdict::gave_up);
    EXPECT_EQ(d.result.detail, "length_budget");
    EXPECT_NEAR(d.result.path_m, 1.0, 0.05);
    EXPECT_EQ(d.complaint, "");
  }
}

TEST(Run, AClosedRoomGivesNoExitOrABudget) {
  Scenario s = small_world("[[polygon]]\npoints = [[1.7, -0.3], [2.3, -0.3], [2.3, 0.3], [1.7, 0.3]]\n");
  s.robot.boundary.length_budget = 6_m;
  s.time_limit_s = 600;
  const Drive d = drive(s, PlannerKind::thesis);
  EXPECT_EQ(d.result.verdict, Verdict::gave_up);
  EXPECT_EQ(d.complaint, "");
}

TEST(Planners, AreFoundByTheirNames) {
  for (const PlannerKind kind : planners()) EXPECT_EQ(planner_named(name(kind)), kind) << name(kind);
  EXPECT_EQ(planner_named("boundary"), PlannerKind::boundary);
  EXPECT_EQ(planner_named("Boundary"), std::nullopt);
}

TEST(Run, AFlankThatNoBeamSeesIsNotTouched) {
  // A pole beside the path, behind the cones when the step starts.
  const Drive d =
      drive(small_world("[[disc]]\ncenter = [0.06, 0.105]\nradius_m = 0.02\n"), PlannerKind::thesis);
  EXPECT_EQ(d.result.verdict, Verdict::reached);
  EXPECT_GT(d.result.min_clearance_m, 0.0);
}

TEST(Run, AContactIsReported) {
  // Sensors that never detect anything.
  Scenario s = small_world("[[disc]]\ncenter = [0.5, 0.0]\nradius_m = 0.1\n");
  s.noise.range_false_clear = 1.0;
  const Drive d = drive(s);
  EXPECT_EQ(d.result.verdict, Verdict::contact);
  EXPECT_EQ(d.complaint, "");
  EXPECT_LE(d.result.min_clearance_m, 1e-9);
  EXPECT_EQ(d.records.size(), d.result.ticks + 1);
}

TEST(Run, ASensorThatFailsForGoodIsAFault) {
  Scenario s = small_world("");
  s.noise.range_dropout = 1.0;
  const Drive d = drive(s);
  EXPECT_EQ(d.result.verdict, Verdict::fault);
  EXPECT_EQ(d.result.detail, "range_lost");
  EXPECT_LT(d.result.time_s, 1.5);
}

TEST(Run, DropoutsAndFalseClearsCostTimeAndNothingElse) {
  Scenario s = parse_scenario(R"(
    name = "noisy"
    [start]
    x_m = 0.0
    y_m = 0.0
    [goal]
    x_m = 3.0
    y_m = 0.0
    [[disc]]
    center = [1.5, 0.1]
    radius_m = 0.4
    [noise]
    range_sigma_m = 0.01
    range_dropout = 0.1
    range_false_clear = 0.05
)",
                              "noisy.toml");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    s.seed = seed;
    const Drive d = drive(s);
    EXPECT_EQ(d.result.verdict, Verdict::reached) << "seed " << seed;
    EXPECT_EQ(d.complaint, "") << "seed " << seed;
  }
}

TEST(Run, TheSeedOfTheNoiseDecidesAndOptionsOverrideIt) {
  Scenario s = load_scenario(kScenarios / "two_discs.toml");
  s.noise.range_sigma_m = 0.01;
  RunOptions other;
  other.seed = s.seed + 1;
  EXPECT_EQ(run(s).hash, run(s).hash);
  EXPECT_NE(run(s).hash, run(s, other).hash);
  s.seed += 1;
  EXPECT_EQ(run(s).hash, run(s, other).hash);
}

// Whatever the outcome, the judge must find no contradiction to the verdict.
TEST(Run, NothingEscapesTheJudgeInRandomWorlds) {
  int verdicts[6] = {};
  for (const auto kind :
       {worlds::Kind::discs, worlds::Kind::poles, worlds::Kind::u_trap, worlds::Kind::spiral,
        worlds::Kind::maze, worlds::Kind::rooms, worlds::Kind::enclosed}) {
    for (std::uint64_t seed = 1; seed <= test::effort(12); ++seed) {
      worlds::Options options;
      options.seed = seed;
      options.noise = seed % 3 == 0;
      Scenario s = worlds::generate(kind, options);
      s.time_limit_s = 400;
      const Drive d = drive(s);
      EXPECT_EQ(d.complaint, "") << s.name;
      ++verdicts[static_cast<int>(d.result.verdict)];
    }
  }
  const auto of = [&](Verdict verdict) { return verdicts[static_cast<int>(verdict)]; };
  std::printf("84 worlds, seeds 1-12: %d reached, %d off the goal, %d gave up, %d contacts, %d faults\n",
              of(Verdict::reached), of(Verdict::off_goal), of(Verdict::gave_up), of(Verdict::contact),
              of(Verdict::fault));
  EXPECT_GT(of(Verdict::reached), 10);
  EXPECT_EQ(of(Verdict::fault), 0);
}

}  // namespace
}  // namespace whisker
