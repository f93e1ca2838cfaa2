#include "host/play/drive.hpp"

#include <gtest/gtest.h>

#include "host/run/runner.hpp"
#include "host/worlds/generate.hpp"

namespace whisker::play {
namespace {

constexpr int kMost = 1000000;

Scenario u_trap() {
  worlds::Options options;
  options.seed = 2;
  return worlds::generate(worlds::Kind::u_trap, options);
}

RunResult by_skirt(const Scenario& scenario) {
  RunOptions options;
  options.planner = PlannerKind::skirt;
  return run(scenario, options);
}

TEST(Drive, IsTheRunHoweverItsTicksAreCut) {
  worlds::Options options;
  options.noise = true;
  const Scenario scenario = worlds::generate(worlds::Kind::u_trap, options);
  const RunResult expected = by_skirt(scenario);
  for (const int ticks : {1, 7, kMost}) {
    Drive drive(scenario, PlannerKind::skirt, fuzzy::kDefaultTable);
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
  Drive drive(scenario, PlannerKind::skirt, fuzzy::kDefaultTable);
  while (!drive.mission().verdict()) {
    drive.advance(50);
    if (!drive.mission().verdict()) drive.change(scenario);
  }
  EXPECT_EQ(drive.mission().result().hash, by_skirt(scenario).hash);
}

TEST(Drive, ReachesAGoalThatMovesAgainAndAgain) {
  Scenario scenario;
  scenario.goal.at = {1, 0};
  Drive drive(scenario, PlannerKind::skirt, fuzzy::kDefaultTable);
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
  Drive drive(scenario, PlannerKind::skirt, fuzzy::kDefaultTable);
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
  Drive drive(scenario, PlannerKind::skirt, fuzzy::kDefaultTable);
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

}  // namespace
}  // namespace whisker::play
