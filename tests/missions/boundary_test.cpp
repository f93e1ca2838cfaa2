// The boundary planner ends with a true verdict, with and without a map, for any start and any surroundings.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "firmware/planning/boundary/table_boundary_planner.hpp"
#include "firmware/robot.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/sim/sim_board.hpp"
#include "host/harness/worlds/generate.hpp"
#include "tests/effort.hpp"

namespace whisker {
namespace {

Scenario scene(const std::string& goal, const std::string& obstacles, const std::string& start = "0.0") {
  return parse_scenario("time_limit_s = 1800.0\n[start]\nx_m = " + start +
                            "\ny_m = 0.0\nheading_deg = 0.0\n[goal]\n" + goal + obstacles,
                        "scene.toml");
}

const std::string kAhead = "x_m = 4.0\ny_m = 0.0\n";

std::string wall(const std::string& points) { return "[[wall]]\npoints = " + points + "\n"; }

struct Case {
  const char* name;
  Scenario scenario;
  Verdict verdict;
};

RunResult drive(const Scenario& scenario, PlannerKind planner) {
  RunOptions options;
  options.planner = planner;
  return run(scenario, options);
}

constexpr PlannerKind kBoth[] = {PlannerKind::boundary, PlannerKind::map};

void expect(const Case& c) {
  for (const PlannerKind planner : kBoth) {
    SCOPED_TRACE(std::string(name(planner)) + ", " + c.name);
    const RunResult r = drive(c.scenario, planner);
    EXPECT_EQ(static_cast<int>(r.verdict), static_cast<int>(c.verdict)) << r.detail;
    EXPECT_GT(r.min_clearance_m, 0);
    EXPECT_LT(r.path_m, 410);
  }
}

TEST(BoundaryPlanner, GetsOutOfTraps) {
  const std::string u = "[[1.0, -1.0], [2.0, -1.0], [2.0, 1.0], [1.0, 1.0]]";
  const std::string inner = "[[1.3, -0.5], [1.7, -0.5], [1.7, 0.5], [1.3, 0.5]]";
  const std::string g =
      "[[1.0, 0.3], [1.0, 1.2], [2.5, 1.2], [2.5, -1.2], [1.0, -1.2], [1.0, -0.3], [1.6, -0.3]]";
  std::string comb;
  for (int i = -4; i <= 4; ++i) {
    const std::string y = std::to_string(0.5 * i);
    comb += wall("[[1.2, " + y + "], [2.2, " + y + "]]");
  }
  comb += wall("[[2.2, -2.0], [2.2, 2.0]]");
  const std::string shell =
      "[[-0.4, -0.4], [0.5, -0.4], [0.5, 0.5], [-0.9, 0.5], [-0.9, -0.9], [1.0, -0.9], [1.0, 1.0], [-1.4, "
      "1.0]]";
  const Case cases[] = {{"U", scene(kAhead, wall(u)), Verdict::reached},
                        {"U within a U", scene(kAhead, wall(u) + wall(inner)), Verdict::reached},
                        {"G with a lip", scene(kAhead, wall(g)), Verdict::reached},
                        {"comb", scene(kAhead, comb), Verdict::reached},
                        {"spiral around the start", scene(kAhead, wall(shell)), Verdict::reached}};
  for (const Case& c : cases) expect(c);
}

std::string gate(double width) {
  const std::string half = std::to_string(width / 2);
  return wall("[[2.0, -3.0], [2.0, -" + half + "]]") + wall("[[2.0, " + half + "], [2.0, 3.0]]") +
         "[bounds]\nmin = [-1.0, -3.0]\nmax = [5.0, 3.0]\n";
}

TEST(BoundaryPlanner, TellsAGapFromAWall) {
  const Case cases[] = {{"wide", scene(kAhead, gate(0.29)), Verdict::reached},
                        {"narrower than the body", scene(kAhead, gate(0.17)), Verdict::unreachable}};
  for (const Case& c : cases) expect(c);
}

TEST(BoundaryPlanner, FindsTheUnreachableUnreachable) {
  const std::string box = "[[3.0, -1.0], [5.0, -1.0], [5.0, 1.0], [3.0, 1.0], [3.0, -1.0]]";
  const std::string cell = "[[-0.5, -0.6], [0.7, -0.6], [0.7, 0.6], [-0.5, 0.6], [-0.5, -0.6]]";
  const std::string tight = "[[-0.12, -0.12], [0.12, -0.12], [0.12, 0.12], [-0.12, 0.12], [-0.12, -0.12]]";
  const std::string disc = "[[disc]]\ncenter = [4.0, 0.0]\nradius_m = 0.5\n";
  const Case cases[] = {{"the goal is fenced in", scene(kAhead, wall(box)), Verdict::unreachable},
                        {"the goal is in a disc", scene(kAhead, disc), Verdict::unreachable},
                        {"the start is fenced in", scene(kAhead, wall(cell)), Verdict::unreachable}};
  for (const Case& c : cases) expect(c);
  for (const PlannerKind planner : kBoth) {
    const RunResult r = drive(scene(kAhead, wall(tight)), planner);
    EXPECT_TRUE(r.verdict == Verdict::gave_up || r.verdict == Verdict::unreachable ||
                r.verdict == Verdict::fault);
    EXPECT_GT(r.min_clearance_m, 0);
  }
}

TEST(BoundaryPlanner, StartsWhereItIsPut) {
  const std::string behind = "[[disc]]\ncenter = [-0.2901, 0.0]\nradius_m = 0.2\n";
  const std::string beside = "[[disc]]\ncenter = [0.0, 0.2901]\nradius_m = 0.2\n";
  const Case cases[] = {{"at the goal", scene("x_m = 0.0\ny_m = 0.0\n", ""), Verdict::reached},
                        {"an obstacle at its back", scene(kAhead, behind), Verdict::reached},
                        {"an obstacle at its flank", scene(kAhead, beside), Verdict::reached},
                        {"the goal behind", scene("x_m = -4.0\ny_m = 0.0\n", ""), Verdict::reached}};
  for (const Case& c : cases) expect(c);
}

TEST(BoundaryPlanner, TakesAnotherGoalOrNoneWhileItFollowsAWall) {
  const Scenario s = scene(kAhead, wall("[[1.5, -2.0], [1.5, 2.0]]"));
  const SimWorld world(s);
  sim::Plant plant(world.view(), robot_spec(s), noise_spec(s.noise), 1, s.start);
  hal::SimBoard board(plant);
  planning::TableBoundaryPlanner boundary(s.robot, fuzzy::kDefaultTable);
  Robot robot(board, board, boundary.planner, s.robot);
  robot.place(fixed_pose(s.start));
  robot.set_goal({{4_m, Length{}}, 100_mm});
  std::uint32_t now = 0;
  const auto drive = [&](auto&& until) {
    for (int i = 0; i < 20000; ++i) {
      const Status& status = robot.tick(Time::from_raw(now));
      now += 10;
      plant.advance();
      if (until(status)) return true;
    }
    return false;
  };
  ASSERT_TRUE(drive([](const Status& t) { return t.decision.why == planning::Why::edge; }));
  robot.set_goal({{Length{}, 1_m}, 100_mm});
  ASSERT_TRUE(drive([](const Status& t) { return t.decision.outcome == planning::Outcome::reached; }));
  EXPECT_NEAR(plant.pose().at.x, 0.0, 0.11);
  EXPECT_NEAR(plant.pose().at.y, 1.0, 0.11);
  robot.set_goal({{4_m, Length{}}, 100_mm});
  ASSERT_TRUE(drive([](const Status& t) { return t.decision.why == planning::Why::edge; }));
  robot.cancel();
  ASSERT_TRUE(drive([&](const Status& t) {
                return t.decision.mode == planning::Mode::idle && plant.v_left() == 0;
              }) ||
              std::fabs(plant.v_left()) < 1e-6);
  EXPECT_FALSE(plant.in_contact());
}

class BoundaryPlannerIn : public testing::TestWithParam<worlds::Kind> {};

TEST_P(BoundaryPlannerIn, EveryWorldComesToItsTrueVerdict) {
  for (std::uint64_t seed = 1; seed <= test::effort(8); ++seed) {
    worlds::Options options;
    options.seed = 300 + seed;
    const Scenario s = worlds::generate(GetParam(), options);
    const Verdict truth = GetParam() == worlds::Kind::enclosed ? Verdict::unreachable : Verdict::reached;
    for (const PlannerKind planner : kBoth) {
      const RunResult r = drive(s, planner);
      EXPECT_EQ(static_cast<int>(r.verdict), static_cast<int>(truth))
          << name(planner) << ", " << s.name << ": " << r.detail;
      EXPECT_GT(r.min_clearance_m, 0) << name(planner) << ", " << s.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Worlds, BoundaryPlannerIn, testing::ValuesIn(worlds::kKinds), [](const auto& kind) {
  std::string name = worlds::name(kind.param);
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
});

}  // namespace
}  // namespace whisker
