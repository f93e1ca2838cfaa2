// What the guard grants, and what it says of it.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/guard/bench.hpp"

namespace whisker::test {
namespace {

constexpr Q14 kAll = Q14::ratio(1, 1);
constexpr Velocity kAhead{300_mm_per_s, {}};

Scenario open_ground() {
  Scenario s;
  s.goal.at = {100, 0};
  return s;
}

Scenario wall_at(double x) {
  Scenario s = open_ground();
  s.walls.push_back({{x, -3}, {x, 3}});
  return s;
}

TEST(Guard, GrantsEverythingOnGroundThatIsVouchedFor) {
  GuardBench bench(open_ground());
  bench.guard.vouch(350_mm);
  const GuardStatus& status = bench.drive(kAhead, 2);
  EXPECT_EQ(status.reason, GuardReason::clear);
  EXPECT_GE(status.forward, Q14::ratio(99, 100));
  EXPECT_EQ(status.turning, kAll);
  EXPECT_GT(bench.plant.path_length(), 0.5);
}

TEST(Guard, NodsWhereNobodyVouchesAndComesBackToTheHeading) {
  GuardBench bench(open_ground());
  bool nodded = false;
  double farthest = 0;
  for (int i = 0; i < 600; ++i) {
    nodded |= bench.drive(kAhead, 0.01).reason == GuardReason::nodding;
    farthest = std::fmax(farthest, std::fabs(bench.plant.pose().heading));
  }
  EXPECT_TRUE(nodded);
  EXPECT_GT(farthest, 0.3);
  EXPECT_NEAR(bench.plant.pose().heading, 0, 0.06);
  EXPECT_GT(bench.plant.path_length(), 0.5);
}

TEST(Guard, StandsBeforeUnseenGroundWithoutNods) {
  Scenario s = open_ground();
  s.robot.guard.nods = Fitted::no;
  GuardBench bench(s);
  const GuardStatus& status = bench.drive(kAhead, 3);
  EXPECT_EQ(status.reason, GuardReason::unseen);
  EXPECT_EQ(status.forward, Q14{});
  EXPECT_LT(bench.plant.path_length(), 0.02);
  EXPECT_NEAR(bench.plant.pose().heading, 0, 1e-3);
}

TEST(Guard, NamesAnObstacleAndStandsBeforeIt) {
  GuardBench bench(wall_at(0.6));
  bench.guard.vouch(350_mm);
  const GuardStatus& status = bench.drive(kAhead, 8);
  EXPECT_EQ(status.reason, GuardReason::obstacle);
  EXPECT_EQ(status.forward, Q14{});
  EXPECT_FALSE(bench.plant.in_contact());
  EXPECT_GT(bench.plant.path_length(), 0.4);
  // It may turn away all the same.
  EXPECT_EQ(bench.drive({{}, 1000_mrad_per_s}, 0.5).reason, GuardReason::clear);
}

TEST(Guard, WhoeverVouchesWronglyIsOverriddenByAnEcho) {
  GuardBench bench(wall_at(0.14));
  bench.guard.vouch(350_mm);
  bench.drive(kAhead, 5);
  EXPECT_FALSE(bench.plant.in_contact());
}

TEST(Guard, LateVouchingDoesNotCountAfterTheBodyHasMoved) {
  Scenario s = open_ground();
  s.robot.guard.nods = Fitted::no;
  GuardBench bench(s);
  bench.guard.vouch(350_mm);
  bench.board.blind = true;
  bench.step();
  bench.guard.reset();
  bench.board.blind = false;
  bench.drive(kAhead, 1);
  EXPECT_LT(bench.plant.path_length(), 0.02);
}

/// Time and way from the last command to standstill, as an observer outside sees them.
struct Stop {
  double time_s, way_m;
};
Stop stop_after_last_command(Duration timeout) {
  Scenario s = open_ground();
  s.robot.guard.command_timeout = timeout;
  GuardBench bench(s);
  bench.guard.vouch(350_mm);
  bench.drive(kAhead, 3);
  EXPECT_NEAR(bench.speed(), 0.3, 0.002);
  bench.guard.command(kAhead, bench.now());
  const double t = bench.plant.time(), way = bench.plant.path_length();
  while (bench.speed() > 0.001 && bench.plant.time() < t + 5) bench.step();
  EXPECT_EQ(bench.guard.status().reason, GuardReason::command_timeout);
  return {bench.plant.time() - t, bench.plant.path_length() - way};
}

TEST(Guard, StopsAfterTheTimeOutATickAndBraking) {
  for (const int ms : {50, 100, 150, 200, 250, 1000}) {
    const Stop stop = stop_after_last_command(milliseconds(ms));
    std::printf("time-out %4d ms: stands after %.3f s and %.1f mm\n", ms, stop.time_s, stop.way_m * 1000);
    // 0.3 m/s at 1 m/s^2, and the motors' lag of 50 ms until 1 mm/s is left.
    const double braking_s = 0.3 + 0.05 * std::log(0.3 / 0.001);
    EXPECT_LT(stop.time_s, ms * 1e-3 + 0.01 + braking_s);
    EXPECT_LT(stop.way_m, 0.3 * (ms * 1e-3 + 0.01) + 0.045 + 0.3 * 0.05 + 0.001);
  }
}

TEST(Guard, ACommandOfTheFutureHoldsNoLonger) {
  GuardBench bench(open_ground());
  bench.guard.vouch(350_mm);
  bench.drive(kAhead, 1);
  bench.guard.command(kAhead, bench.now() + 100000_ms);
  for (int i = 0; i < 27; ++i) bench.step();
  EXPECT_EQ(bench.guard.status().reason, GuardReason::command_timeout);
}

TEST(Guard, StandsWithoutACommand) {
  GuardBench bench(open_ground());
  EXPECT_EQ(bench.step().reason, GuardReason::command_timeout);
  EXPECT_EQ(bench.guard.status().command.left, 0);
}

TEST(Guard, BrakesForStaleRangesAndStopsForLostOnes) {
  GuardBench bench(open_ground());
  bench.guard.vouch(350_mm);
  bench.drive(kAhead, 1);
  bench.board.blind = true;
  EXPECT_EQ(bench.drive(kAhead, 0.2).reason, GuardReason::stale_ranges);
  EXPECT_EQ(bench.drive(kAhead, 1.5).reason, GuardReason::fault);
  EXPECT_EQ(bench.guard.status().health.fault, Fault::range_lost);
  EXPECT_NEAR(bench.speed(), 0, 1e-3);
  bench.board.blind = false;
  EXPECT_EQ(bench.drive(kAhead, 0.5).reason, GuardReason::fault);
  bench.guard.reset();
  bench.guard.vouch(350_mm);
  EXPECT_NE(bench.drive(kAhead, 1).reason, GuardReason::fault);
  EXPECT_GT(bench.speed(), 0.2);
}

TEST(Guard, RefusesParametersThatItCannotKeepSafe) {
  Scenario s = open_ground();
  s.robot.bumper = {Fitted::yes, 50_mm_per_s};
  GuardBench bench(s);
  const GuardStatus& status = bench.drive(kAhead, 0.5);
  EXPECT_EQ(status.health.fault, Fault::invalid_params);
  EXPECT_EQ(status.reason, GuardReason::fault);
  EXPECT_EQ(bench.plant.path_length(), 0);
}

TEST(Guard, ScalesWhatTheWheelsCannotDoAndSaysSo) {
  GuardBench bench(open_ground());
  bench.guard.vouch(350_mm);
  const GuardStatus& status = bench.drive({Speed::from_raw(INT32_MAX), {}}, 2);
  EXPECT_EQ(status.reason, GuardReason::limits);
  EXPECT_NEAR(bench.speed(), 0.3, 0.002);
}

TEST(Guard, TheClockMayWrap) {
  GuardBench bench(open_ground());
  bench.now_ms = UINT32_MAX - 1000;
  bench.guard.vouch(350_mm);
  EXPECT_EQ(bench.drive(kAhead, 3).reason, GuardReason::clear);
}

TEST(Guard, EveryReasonHasAName) {
  for (int i = 0; i < kGuardReasons; ++i) EXPECT_STRNE(name(static_cast<GuardReason>(i)), "?");
  EXPECT_STREQ(name(static_cast<GuardReason>(kGuardReasons)), "?");
}

}  // namespace
}  // namespace whisker::test
