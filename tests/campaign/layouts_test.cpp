// The mountings that `whisker robot layout` compares, and how it ranks them.
#include "host/lab/campaign/layouts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "host/harness/scenario/error.hpp"
#include "host/harness/scenario/write.hpp"
#include "host/lab/campaign/worlds.hpp"
#include "tests/campaign/rows.hpp"

namespace whisker::campaign {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const SensorModel& model(const char* name) { return *find_sensor_model(name); }

TEST(Equipped, TakesFromTheModelWhatItStates) {
  Params robot;
  robot.rangefinders.side_angle = 45_deg;
  robot.rangefinders.beams[0].x = 10_mm;
  const Params p = equipped(robot, model("hc-sr04"));
  EXPECT_EQ(p.rangefinders.incidence, 40_deg);
  EXPECT_EQ(p.rangefinders.cone, 15_deg);
  EXPECT_EQ(p.rangefinders.min_range, 20_mm);
  EXPECT_EQ(p.rangefinders.max_range, 4_m);
  EXPECT_EQ(p.rangefinders.rate_hz, 16);
  EXPECT_EQ(p.rangefinders.latency, 25_ms);
  EXPECT_GT(p.conditioning.stale_after, 200_ms);
  EXPECT_EQ(p.rangefinders.beams[0].x, Length{});
  EXPECT_EQ(check(p), ParamFault::none);
}

TEST(Equipped, CountsATaperingConeWhereReadingsClearGround) {
  Params robot;
  robot.rangefinders.clear_range = 600_mm;
  const RangefinderParams r = equipped(robot, model("hc-sr04")).rangefinders;
  // 40 degrees at the apex, 15 at 4 m.
  EXPECT_NEAR(r.cone.wrapped() * (180.0 / 2147483648.0), 36.25, 1e-6);
  EXPECT_EQ(r.clear_range, 600_mm);
}

TEST(Equipped, ShortensStepsToTheRange) {
  const Params p = equipped({}, model("gp2y0a41"));
  EXPECT_EQ(derived::base_step(p), 90_mm);
  EXPECT_EQ(derived::base_step(equipped({}, model("vl53l0x"))), derived::kLongestStep);
}

TEST(Scaled, RobotsOfEverySizeFit) {
  for (const double radius : {0.05, 0.09, 0.2, 0.3}) {
    const Params p = equipped(scaled({}, radius / 0.09), model("vl53l0x"));
    EXPECT_EQ(p.body.radius, micrometres(static_cast<std::int32_t>(radius * 1e6 + 0.5)));
    EXPECT_EQ(check(p), ParamFault::none) << name(check(p)) << " " << radius;
  }
  EXPECT_EQ(scaled({}, 2).boundary.guard_margin, 8_mm);
  EXPECT_EQ(scaled({}, 2).rangefinders.max_range, 2_m);
}

TEST(Grid, HoldsTheAngleOfTheRuleWithItsMargin) {
  const Params robot = equipped({}, model("hc-sr04"));
  EXPECT_NEAR(rule_angle_deg(robot, false), 42.5, 1e-6);
  const LayoutGrid grid = layout_grid(robot);
  EXPECT_THAT(grid.angles_deg, ElementsAre(25, 30, 35, 40, 45, 47.5, 50, 55, 60, 65));
  EXPECT_THAT(grid.offsets_m, ElementsAre(0, 0.045, 0.081));
  EXPECT_EQ(grid.layouts.size() + grid.refused, 30U);
  // A sensor that sees walls at nearly every angle: the rule's angle lies below the grid.
  EXPECT_EQ(layout_grid(equipped({}, model("vl53l1x"))).angles_deg.size(), 9U);
  EXPECT_THAT(layout_grid(robot, {50, 40, 50}).angles_deg, ElementsAre(40, 50));
}

TEST(Grid, SkipsAndCountsWhatCheckRefuses) {
  const LayoutGrid wide = layout_grid(equipped({}, model("vl53l1x")), {30, 80});
  EXPECT_EQ(wide.refused, 3U);
  EXPECT_EQ(wide.refusals[static_cast<std::size_t>(ParamFault::cones_apart_from_front)], 3U);
  for (const Layout& layout : wide.layouts) {
    EXPECT_EQ(check(layout.robot), ParamFault::none);
    EXPECT_EQ(layout.robot.rangefinders.side_angle, 30_deg);
  }
}

TEST(Scenario, IsTheSameWorldForEveryLayoutOfASize) {
  const LayoutGrid grid = layout_grid(equipped(scaled({}, 2), model("vl53l1x")), {30, 40});
  Sensor sensor;
  sensor.incidence_deg = 33;
  const Scenario a = layout_scenario(grid.layouts[0], sensor, worlds::Kind::rooms, 5);
  const Scenario b = layout_scenario(grid.layouts[1], sensor, worlds::Kind::rooms, 5);
  EXPECT_EQ(a.goal.at.x, b.goal.at.x);
  EXPECT_EQ(a.walls.size(), b.walls.size());
  EXPECT_EQ(a.sensor.incidence_deg, 33);
  EXPECT_EQ(b.robot.rangefinders.side_angle, 40_deg);
  EXPECT_EQ(a.time_limit_s, 2 * kLayoutTimeLimit);
}

Layout layout(double angle, double offset = 0) {
  Layout l{angle, offset, equipped({}, model("hc-sr04"))};
  l.robot.rangefinders.side_angle = Angle::turns(static_cast<std::int32_t>(angle * 10), 3600);
  return l;
}

Row row(Verdict verdict, double time_s) {
  Row r;
  r.verdict = verdict;
  r.time_s = time_s;
  r.shortest_m = 1;
  return r;
}

/// Eight missions; the last ones touch, and those before them give up.
LayoutScore scored(double angle, int contacts, int given_up, double time_s) {
  std::vector<Row> rows(8, row(Verdict::reached, time_s));
  for (int i = 0; i < contacts; ++i) rows[static_cast<std::size_t>(7 - i)].verdict = Verdict::contact;
  for (int i = 0; i < given_up; ++i)
    rows[static_cast<std::size_t>(7 - contacts - i)].verdict = Verdict::gave_up;
  return score(layout(angle), {}, rows);
}

TEST(Score, CountsMissionsAndTakesMediansOverAllOfThem) {
  std::vector<Row> rows;
  for (const double t : {4.0, 6.0, 8.0, 2.0}) rows.push_back(row(Verdict::reached, t));
  for (int i = 0; i < 3; ++i) rows.push_back(row(Verdict::gave_up, 1));
  rows.push_back(row(Verdict::contact, 1));
  const LayoutScore s = score(layout(47.5), {}, rows);
  EXPECT_EQ(s.missions, 8U);
  EXPECT_EQ(s.reached, 4U);
  EXPECT_EQ(s.contacts, 1U);
  EXPECT_EQ(s.s_per_m, 8) << "the others count as infinite";
  EXPECT_EQ(s.world_s_per_m[0], 4);
  EXPECT_EQ(s.world_s_per_m[1], 2);
  EXPECT_EQ(s.world_s_per_m[2], std::nullopt);
  EXPECT_NEAR(s.margin_deg, 5, 1e-6);
  EXPECT_NEAR(s.needed_incidence_deg, 35, 1e-6);
  rows[0].verdict = Verdict::off_goal;
  EXPECT_EQ(score(layout(47.5), {}, rows).s_per_m, std::nullopt);
}

TEST(Rank, PutsWallsBeforeContactsBeforeGoalsBeforeTime) {
  std::vector<LayoutScore> all = {scored(40, 0, 0, 1), scored(45, 0, 0, 2),  scored(50, 1, 0, 3),
                                  scored(55, 0, 1, 4), scored(60, 0, 0, 20), scored(65, 0, 0, 10)};
  rank(all);
  std::vector<double> angles;
  for (const LayoutScore& s : all) angles.push_back(s.layout.side_angle_deg);
  EXPECT_THAT(angles, ElementsAre(65, 60, 55, 50, 45, 40));
  EXPECT_EQ(
      reason(all),
      "of 6 layouts, 4 see every wall ahead with 5 degrees to spare; 3 of these with the fewest contacts "
      "(0 in 8 missions; 95 % bound 32 %); 2 of these with the most goals reached (8 of 8); the fastest of "
      "these (10.0 s/m)");
}

TEST(Rank, SaysWhereNoLayoutSeesEveryWall) {
  std::vector<LayoutScore> all = {scored(30, 0, 8, 1), scored(40, 0, 8, 1)};
  rank(all);
  EXPECT_THAT(reason(all), HasSubstr("none sees every wall ahead, so that all 2 are compared"));
  EXPECT_THAT(reason(all), HasSubstr("no time is compared"));
  all.push_back(scored(45, 3, 0, 1));
  rank(all);
  EXPECT_EQ(all.front().layout.side_angle_deg, 45);
  EXPECT_THAT(reason(all), HasSubstr("1 see every wall ahead, none of them with 5 degrees to spare"));
}

Scenario generated(std::uint64_t seed) {
  worlds::Options options;
  options.seed = seed;
  options.discs = 5;
  return worlds::generate(worlds::Kind::discs, options);
}

TEST(Generated, MissionsHaveOneSeedAfterTheOther) {
  Generated worlds{worlds::Kind::discs, {}, 40};
  worlds.options.discs = 5;
  for (const std::uint64_t i : {0U, 1U, 7U}) {
    const Mission m = mission(worlds, i);
    EXPECT_EQ(m.seed, 40 + i);
    EXPECT_EQ(m.world, "discs --discs 5");
    EXPECT_EQ(to_toml(m.scenario), to_toml(generated(40 + i)));
  }
}

TEST(Generated, TheArgumentsNameEveryOption) {
  worlds::Options options;
  EXPECT_EQ(arguments(worlds::Kind::u_trap, options), "u-trap");
  options = {1, 0, true, true};
  EXPECT_EQ(arguments(worlds::Kind::enclosed, options), "enclosed --discs 0 --box --noise");
  options = {1, {}, false, true, 5e-05};
  EXPECT_EQ(arguments(worlds::Kind::maze, options), "maze --noise --wheel-scale-sigma 5e-05");
}

TEST(FilesOfAFolder, AreItsScenarioFilesInOrderOfName) {
  const Folder folder;
  folder.file("b.toml", to_toml(generated(7)));
  folder.file("a.toml", to_toml(generated(8)));
  folder.file("notes.txt", "no scenario");
  Files files = load_folder(folder.path(""));
  ASSERT_EQ(files.names.size(), 2U);
  EXPECT_EQ(mission(files, 0).seed, 8U);
  EXPECT_EQ(mission(files, 1).seed, 7U) << "its own";
  EXPECT_EQ(mission(files, 1).world, files.names[1]);
  files.first_seed = 100;
  EXPECT_EQ(mission(files, 0).scenario.seed, 100U);
  EXPECT_EQ(mission(files, 3).scenario.seed, 103U);
  EXPECT_EQ(mission(files, 3).world, files.names[1]) << "each file in turn";
}

TEST(FilesOfAFolder, AreJudgedWithTheRobotThatDrives) {
  const Folder folder;
  folder.file(
      "a.toml",
      "[start]\nx_m = 0\ny_m = 0\n[goal]\nx_m = 4\ny_m = 0\n[[disc]]\ncenter = [0.38, 0]\nradius_m = 0.3\n");
  folder.file("robot", "body_radius_m = 0.05\nwheel_track_m = 0.08\n");
  EXPECT_THROW(load_folder(folder.path("")), InputError);
  EXPECT_EQ(load_folder(folder.path(""), folder.path("robot")).scenarios[0].robot.body.radius, 50_mm);
}

TEST(FilesOfAFolder, AreRefusedIfAnyIsWrong) {
  const Folder folder;
  EXPECT_THROW(load_folder(folder.path("")), std::invalid_argument) << "none at all";
  folder.file("a.toml", to_toml(generated(8)));
  folder.file("b.toml", "nonsense");
  EXPECT_THROW(load_folder(folder.path("")), InputError);
  folder.file("b.toml", to_toml(generated(8)));
  folder.file("c\n.toml", to_toml(generated(8)));
  EXPECT_THROW(load_folder(folder.path("")), std::invalid_argument);
}

}  // namespace
}  // namespace whisker::campaign
