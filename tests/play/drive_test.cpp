#include "host/lab/play/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/harness/run/runner.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/lab/guard/drive.hpp"
#include "host/lab/play/guard_drive.hpp"

namespace whisker::play {
namespace {

constexpr int kMost = 1000000;

Scenario u_trap() {
  worlds::Options options;
  options.seed = 2;
  return worlds::generate(worlds::Kind::u_trap, options);
}

RunResult by_boundary(const Scenario& scenario) {
  RunOptions options;
  options.planner = PlannerKind::boundary;
  return run(scenario, options);
}

TEST(Drive, IsTheRunHoweverItsTicksAreCut) {
  worlds::Options options;
  options.noise = true;
  const Scenario scenario = worlds::generate(worlds::Kind::u_trap, options);
  const RunResult expected = by_boundary(scenario);
  for (const int ticks : {1, 7, kMost}) {
    Drive drive(scenario, PlannerKind::boundary, fuzzy::kDefaultTable);
    while (!drive.mission().verdict()) drive.advance(ticks);
    const RunResult result = drive.mission().result();
    EXPECT_EQ(result.hash, expected.hash) << ticks;
    EXPECT_EQ(result.verdict, expected.verdict);
    EXPECT_EQ(result.ticks, expected.ticks);
    EXPECT_EQ(result.time_s, expected.time_s);
    EXPECT_EQ(result.path_m, expected.path_m);
    EXPECT_EQ(result.min_clearance_m, expected.min_clearance_m);
  }
}

TEST(Drive, AChangeToTheSameWorldChangesNothing) {
  const Scenario scenario = u_trap();
  Drive drive(scenario, PlannerKind::boundary, fuzzy::kDefaultTable);
  while (!drive.mission().verdict()) {
    drive.advance(50);
    if (!drive.mission().verdict()) drive.change(scenario);
  }
  EXPECT_EQ(drive.mission().result().hash, by_boundary(scenario).hash);
}

TEST(Drive, ReachesAGoalThatMovesAgainAndAgain) {
  Scenario scenario;
  scenario.goal.at = {1, 0};
  Drive drive(scenario, PlannerKind::boundary, fuzzy::kDefaultTable);
  for (const sim::Vec2 goal : {sim::Vec2{1, 0}, sim::Vec2{0.5, 0.8}, sim::Vec2{-0.5, 0}}) {
    scenario.goal.at = goal;
    drive.change(scenario);
    drive.advance(kMost);
    ASSERT_EQ(drive.mission().verdict(), Verdict::reached);
    EXPECT_LT(drive.mission().distance_left(), scenario.goal.tolerance_m);
  }
}

TEST(Drive, WhoOnlyBelievesToBeThereIsOffTheGoalAndSetsOutAgainForAnother) {
  Scenario scenario;
  scenario.goal.at = {4, 0};
  scenario.noise.wheel_scale_sigma = 0.02;
  Drive drive(scenario, PlannerKind::boundary, fuzzy::kDefaultTable);
  drive.advance(kMost);
  ASSERT_EQ(drive.mission().verdict(), Verdict::off_goal);
  scenario.goal.at = {0, 0};
  drive.change(scenario);
  EXPECT_FALSE(drive.mission().verdict());
  drive.advance(kMost);
  EXPECT_TRUE(says_reached(drive.mission().verdict().value()));
}

TEST(Drive, AContactIsForGood) {
  Scenario scenario;
  scenario.goal.at = {2, 0};
  Drive drive(scenario, PlannerKind::boundary, fuzzy::kDefaultTable);
  drive.advance(300);
  Scenario struck = scenario;
  struck.discs = {{drive.plant().pose().at, 0.2}};
  drive.change(struck);
  drive.advance(1);
  ASSERT_EQ(drive.mission().verdict(), Verdict::contact);
  drive.change(scenario);
  drive.advance(10);
  EXPECT_EQ(drive.mission().verdict(), Verdict::contact);
}

TEST(Drive, ItsWayEndsWhereItIs) {
  Drive drive(u_trap(), PlannerKind::thesis, fuzzy::kDefaultTable);
  drive.advance(3000);
  const sim::Vec2 off = drive.way().back().at - drive.plant().pose().at;
  EXPECT_LT(sim::dot(off, off), 0.005 * 0.005);
  double length = 0;
  for (std::size_t i = 1; i < drive.way().size(); ++i) {
    const sim::Vec2 leg = drive.way()[i].at - drive.way()[i - 1].at;
    length += sim::square_root(sim::dot(leg, leg));
  }
  EXPECT_NEAR(length, drive.plant().path_length(), 0.01 * drive.plant().path_length() + 0.005);
}

guard::Twist asked_at(double t_s) { return {t_s < 8 ? 0.3 : -0.1, 0.4 * std::sin(t_s)}; }

/// The commands of asked_at().
class Swerving final : public guard::Operator {
 public:
  guard::Twist ask(const guard::Sight& sight) override { return asked_at(sight.t_s); }
  double pause_s() override { return 0.005; }  // every tick
};

Scenario discs() {
  worlds::Options options;
  options.seed = 3;
  options.noise = true;
  return worlds::generate(worlds::Kind::discs, options);
}

void swerve(GuardDrive& drive, int ticks) {
  for (int i = 0; i < ticks; ++i) {
    drive.command(asked_at(drive.body().plant().time()));
    drive.advance(1);
  }
}

TEST(GuardDrive, IsTheDriveOfWhiskerGuard) {
  const Scenario scenario = discs();
  for (const GuardDrive::Switches& on : {GuardDrive::Switches{}, {true, false, true}, {true, true, false}}) {
    GuardDrive drive(scenario, on, fuzzy::kResponseTable);
    swerve(drive, 1500);
    Scenario same = scenario;
    same.robot.guard.nods = on.nods ? Fitted::yes : Fitted::no;
    same.robot.guard.assist = on.assist ? Fitted::yes : Fitted::no;
    guard::Options options;
    options.time_s = 15;
    options.until_goal = false;
    Swerving hand;
    const guard::Result expected = guard::drive(same, hand, options);
    EXPECT_EQ(drive.result().hash, expected.hash);
    EXPECT_EQ(drive.result().ticks, expected.ticks);
    EXPECT_EQ(drive.result().path_m, expected.path_m);
    EXPECT_FALSE(drive.over());
  }
}

TEST(GuardDrive, WithoutTheGuardTheNextWallEndsIt) {
  Scenario scenario;
  scenario.walls = {{{1, -1}, {1, 1}}};
  GuardDrive drive(scenario, {false, true, true}, fuzzy::kResponseTable);
  drive.command({0.3, 0});
  drive.advance(1000);
  ASSERT_TRUE(drive.over());
  EXPECT_EQ(drive.result().verdict, Verdict::contact);
  EXPECT_EQ(drive.local_grid(), nullptr);
  const std::uint64_t ticks = drive.result().ticks;
  drive.advance(10);
  EXPECT_EQ(drive.result().ticks, ticks);
}

TEST(GuardDrive, ASwitchStopsTheBodyBeforeANewGuardTakesOver) {
  Scenario scenario;
  scenario.start = {{0.5, -0.2}, 1.0};
  scenario.walls = {{{-2, 2}, {2, 2}}};
  GuardDrive drive(scenario, {false, true, true}, fuzzy::kResponseTable);
  drive.command({0.3, 0});
  drive.advance(300);
  drive.set({true, true, true});
  drive.advance(1);
  EXPECT_FALSE(drive.body().wiring().guarded);
  while (!drive.body().stands()) drive.advance(1);
  drive.advance(1);
  ASSERT_TRUE(drive.body().wiring().guarded);
  const sim::Vec2 off = drive.body().put_down().at - drive.body().plant().pose().at;
  EXPECT_LT(sim::dot(off, off), 1e-6);
  drive.advance(2000);
  EXPECT_FALSE(drive.over());
  const TickRecord r = drive.record();
  EXPECT_NEAR(r.est_x_m, r.x_m, 0.01);
  EXPECT_NEAR(r.est_y_m, r.y_m, 0.01);
}

TEST(GuardDrive, AnObstacleOnTheBodyIsAContact) {
  Scenario scenario;
  GuardDrive drive(scenario, {}, fuzzy::kResponseTable);
  drive.command({0.3, 0});
  drive.advance(800);
  Scenario struck = scenario;
  struck.discs = {{drive.body().plant().pose().at, 0.2}};
  drive.change(struck);
  drive.advance(1);
  EXPECT_EQ(drive.result().verdict, Verdict::contact);
}

}  // namespace
}  // namespace whisker::play
