#include "host/harness/scenario/load.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/scenario/reader.hpp"
#include "host/harness/scenario/world.hpp"

namespace whisker {
namespace {

Scenario good(const std::string& name) {
  return load_scenario(WHISKER_SOURCE_DIR "/tests/scenario/good/" + name + ".toml");
}

const char kLeast[] = "name = \"n\"\n[start]\nx_m = 0\ny_m = 0\n[goal]\nx_m = 4\ny_m = 0\n";
Scenario least_and(const std::string& more) { return parse_scenario(kLeast + more, "text"); }

TEST(Scenario, TakesEveryKeyFromItsFile) {
  const Scenario s = good("every_key");
  EXPECT_EQ(s.name, "two discs and a wall");
  EXPECT_EQ(s.seed, 7U);
  EXPECT_EQ(s.time_limit_s, 300);
  EXPECT_EQ(s.start.at.x, 0);
  EXPECT_EQ(s.start.heading, 90 * kRadPerDeg);
  EXPECT_EQ(s.goal.at.x, 4);
  EXPECT_EQ(s.goal.at.y, 1);
  EXPECT_EQ(s.goal.tolerance_m, 0.2);
  ASSERT_TRUE(s.bounds.has_value());
  EXPECT_EQ(s.bounds->min.y, -3);
  EXPECT_EQ(s.bounds->max.x, 6);
  ASSERT_EQ(s.discs.size(), 2U);
  EXPECT_EQ(s.discs[0].center.y, 0.2);
  EXPECT_EQ(s.discs[1].radius, 1);
  ASSERT_EQ(s.polygons.size(), 1U);
  EXPECT_EQ(s.polygons[0].size(), 3U);
  ASSERT_EQ(s.walls.size(), 1U);
  EXPECT_EQ(s.walls[0][2].x, 3.5);
  ASSERT_EQ(s.movers.size(), 1U);
  EXPECT_EQ(s.movers[0].center.y, -1);
  EXPECT_EQ(s.movers[0].radius_m, 0.15);
  EXPECT_EQ(s.movers[0].path[1].y, 2);
  EXPECT_EQ(s.movers[0].speed_mps, 0.2);
  EXPECT_EQ(s.noise.range_sigma_m, 0.01);
  EXPECT_EQ(s.noise.range_dropout, 0.02);
  EXPECT_EQ(s.noise.range_false_clear, 0.01);
  EXPECT_EQ(s.noise.wheel_scale_sigma, 0.005);
  EXPECT_EQ(s.noise.heading_drift_deg_per_sqrt_m, 0.3);
  EXPECT_EQ(s.noise.wheel_scale_common_sigma, 0.001);
  EXPECT_EQ(s.noise.wheel_slip, 0.05);
  EXPECT_EQ(s.noise.motor_lag_shorter, 0.5);
  EXPECT_EQ(s.noise.gyro_bias_dps, 1);
  EXPECT_EQ(s.noise.gyro_warm_up_dps, 0.1);
  EXPECT_EQ(s.noise.gyro_walk_deg_per_sqrt_h, 0.4);
  EXPECT_EQ(s.noise.gyro_scale_sigma, 0.01);
  EXPECT_EQ(s.noise.fix_every_m, 2);
  EXPECT_EQ(s.noise.fix_sigma_m, 0.03);
  EXPECT_EQ(s.noise.fix_sigma_deg, 1);
  EXPECT_EQ(s.robot.body.radius, 80_mm);
  EXPECT_EQ(s.robot.rangefinders.cone, 20_deg);
  EXPECT_EQ(s.robot.wheels.motor_lag, 30_ms);
  EXPECT_EQ(s.robot.wheels.counts_per_metre, 8000);
  EXPECT_EQ(s.robot.conditioning.consensus, Consensus::median);
}

TEST(Scenario, HasEventsInTheOrderOfTheFile) {
  const std::vector<Event> e = good("every_key").events;
  ASSERT_EQ(e.size(), 11U);
  EXPECT_EQ(e[0].kind, EventKind::goal);
  EXPECT_EQ(e[0].t_s, 20);
  EXPECT_EQ(e[0].goal.at.x, 3.5);
  EXPECT_EQ(e[0].goal.at.y, -1);
  EXPECT_EQ(e[0].goal.tolerance_m, 0.3);
  EXPECT_EQ(e[1].kind, EventKind::correct);
  EXPECT_EQ(e[1].x_m, 1);
  EXPECT_EQ(e[1].y_m, std::nullopt);
  EXPECT_EQ(e[1].heading_deg, 90);
  EXPECT_EQ(e[1].sigma_m, 0.03);
  EXPECT_EQ(e[1].sigma_deg, 2);
  EXPECT_EQ(e[2].kind, EventKind::place);
  EXPECT_EQ(e[2].x_m, std::nullopt);
  Params params;
  EXPECT_TRUE(apply_param(e[3], params));
  EXPECT_EQ(params.wheels.max_speed, 200_mm_per_s);
  params.conditioning.consensus = Consensus::median;
  EXPECT_TRUE(apply_param(e[4], params));
  EXPECT_EQ(params.conditioning.consensus, Consensus::agreeing);
  EXPECT_EQ(e[5].file, "laws/straight.toml");
  EXPECT_EQ(e[6].kind, EventKind::table);
  EXPECT_EQ(e[6].file, "");
  EXPECT_EQ(e[7].for_s, 0.3);
  for (int kind = 0; kind < kEventKinds; ++kind) {
    EXPECT_TRUE(
        std::any_of(e.begin(), e.end(), [&](const Event& x) { return static_cast<int>(x.kind) == kind; }));
  }
  EXPECT_TRUE(good("only_what_is_required").events.empty());
}

TEST(Scenario, HasTheStatedDefaults) {
  const Scenario s = good("only_what_is_required");
  EXPECT_EQ(s.seed, 1U);
  EXPECT_EQ(s.time_limit_s, 600);
  EXPECT_EQ(s.goal.tolerance_m, 0.10);
  EXPECT_NEAR(s.start.heading, std::acos(-1) / 2, 1e-15);
  EXPECT_FALSE(s.bounds.has_value());
  EXPECT_TRUE(s.discs.empty() && s.polygons.empty() && s.walls.empty() && s.movers.empty());
  EXPECT_EQ(s.noise.range_sigma_m, 0);
  EXPECT_EQ(s.noise.range_dropout, 0);
  EXPECT_EQ(s.robot.body.radius, Params{}.body.radius);
}

TEST(Scenario, MayHaveItsGoalOutsideTheBounds) { EXPECT_EQ(good("goal_outside_bounds").goal.at.x, 4); }

TEST(Scenario, TakesItsFilesNameWhereItNamesNone) { EXPECT_EQ(good("without_name").name, "without_name"); }

TEST(Scenario, AcceptsAPolygonThatRepeatsItsFirstPoint) {
  EXPECT_EQ(good("polygon_closed_by_hand").polygons.at(0).size(), 3U);
}

TEST(Scenario, MayHaveItsGoalInsideAnObstacle) { EXPECT_EQ(good("goal_inside_a_disc").discs.size(), 1U); }

TEST(Scenario, MayHaveItsStartJustClearOfAnObstacle) {
  EXPECT_NO_THROW(least_and("[[wall]]\npoints = [[-1, 0.0901], [1, 0.0901]]\n"));
  EXPECT_THROW(least_and("[[wall]]\npoints = [[-1, 0.09], [1, 0.09]]\n"), InputError);
}

TEST(Scenario, MayHaveItsStartInTheHollowOfAPolygon) {
  EXPECT_NO_THROW(
      least_and("[[polygon]]\npoints = [[1, -1], [1, 1], [-1, 1], [-1, 0.9], [0.9, 0.9], "
                "[0.9, -0.9], [-1, -0.9], [-1, -1]]\n"));
}

TEST(Scenario, MayHaveAWallThatEndsWhereItBegins) {
  EXPECT_NO_THROW(least_and("[[wall]]\npoints = [[3, -1], [5, -1], [4, 1], [3, -1]]\n"));
}

TEST(Scenario, MayHaveAMoverThatStandsStill) {
  EXPECT_NO_THROW(
      least_and("[[mover]]\ncenter = [2, 1]\nradius_m = 0.1\npath = [[2, 0], [2, 2]]\nspeed_mps = 0\n"));
}

TEST(World, TurnsEveryOutlineIntoSegments) {
  const World w = make_world(good("every_key"));
  EXPECT_EQ(w.discs.size(), 2U);
  EXPECT_EQ(w.movers.size(), 1U);
  ASSERT_EQ(w.segments.size(), 3U + 2U + 4U);
  // The polygon closes itself; the wall does not.
  EXPECT_EQ(w.segments[2].b.x, 1.0);
  EXPECT_EQ(w.segments[2].b.y, 1.0);
  EXPECT_EQ(w.segments[4].b.x, 3.5);
  for (std::size_t i = 5; i < 9; ++i) {
    const sim::Vec2 along = w.segments[i].b - w.segments[i].a;
    EXPECT_TRUE((std::fabs(along.x) == 7 && along.y == 0) || (along.x == 0 && std::fabs(along.y) == 6));
  }
}

// The table of docs/parameters.md is the generated one, and the example of docs/scenario.md loads.

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  if (from == std::string::npos) return {};
  const std::size_t to = text.find(end, from + begin.size());
  if (to == std::string::npos) return {};
  return text.substr(from + begin.size(), to - from - begin.size());
}

std::string page(const std::string& name) { return read_file(WHISKER_SOURCE_DIR "/docs/" + name); }

TEST(Manual, ListsEveryParameterAsTheCodeHasIt) {
  EXPECT_EQ(between(page("parameters.md"), "<!-- params:begin -->\n", "<!-- params:end -->"),
            params_markdown());
}

TEST(Manual, ShowsAnExampleThatLoads) {
  const std::string example = between(page("scenario.md"), "```toml\n", "```");
  const Scenario s = parse_scenario(example, "example");
  EXPECT_EQ(s.discs.size() + s.polygons.size() + s.walls.size() + s.movers.size(), 4U);
}

}  // namespace
}  // namespace whisker
