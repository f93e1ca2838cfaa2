// What the guard grants, and what it says of it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdio>
#include <tuple>

#include "host/harness/worlds/generate.hpp"
#include "host/lab/campaign/random_robot.hpp"
#include "host/lab/guard/campaign.hpp"
#include "host/lab/guard/drive.hpp"
#include "host/lab/guard/operators.hpp"
#include "tests/effort.hpp"
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

// Whatever is commanded, at whatever rate, the body touches nothing.

constexpr int kParts = 4;

class HostileDrives : public testing::TestWithParam<std::tuple<int, bool>> {};

// WHISKER_LONG=1: 100,000 drives of 20 s.
TEST_P(HostileDrives, TouchNothing) {
  const auto [part, noise] = GetParam();
  const auto count = test::effort(34, 12500);
  const std::uint64_t first = 1 + static_cast<std::uint64_t>(part) * 12500 + (noise ? 50000 : 0);
  double path = 0, gap = 1;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const guard::Result result = guard::hostile_drive(seed, noise, {});
    EXPECT_NE(result.end, guard::End::contact) << "seed " << seed << " at " << result.time_s << " s";
    EXPECT_EQ(result.fault, Fault::none) << name(result.fault) << " seed " << seed;
    path += result.path_m;
    gap = std::fmin(gap, result.min_clearance_m);
  }
  std::printf("%llu drives%s from seed %llu: %.0f m, the smallest gap is %.4f m\n",
              static_cast<unsigned long long>(count), noise ? " with noise" : "",
              static_cast<unsigned long long>(first), path, gap);
  EXPECT_GT(path, static_cast<double>(count) * 0.25);
}

INSTANTIATE_TEST_SUITE_P(Part, HostileDrives, testing::Combine(testing::Range(0, kParts), testing::Bool()));

RC_GTEST_PROP(HostileDrive, TouchesNothingFromAnySeed, (std::uint64_t seed, bool noise)) {
  RC_ASSERT(guard::hostile_drive(seed >> 2, noise, {}).end != guard::End::contact);
}

TEST(HostileDrive, TouchesNothingWithAnyRobot) {
  const auto count = test::effort(20, 2000);
  double path = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    Params robot = campaign::random_robot(seed).params;
    robot.bumper = {};
    const guard::Result result = guard::hostile_drive(seed, false, robot);
    EXPECT_NE(result.end, guard::End::contact) << "seed " << seed << " at " << result.time_s << " s";
    path += result.path_m;
  }
  std::printf("%llu robots, %.0f m\n", static_cast<unsigned long long>(count), path);
}

// The guard is usable: an operator that follows a path arrives, about as fast as without it.

struct Class {
  const char* name;
  int discs;
  bool box;
  Angle cone;
  Angle side;
  double bar_mps;
};

void PrintTo(const Class& c, std::ostream* out) { *out << c.name; }

class PerfectOperator : public testing::TestWithParam<Class> {};

TEST_P(PerfectOperator, Arrives) {
  const Class& c = GetParam();
  int arrived = 0, drives = 0;
  double path = 0, time = 0;
  for (std::uint64_t seed = 1; seed <= test::effort(7, 200); ++seed) {
    worlds::Options options;
    options.seed = seed;
    options.discs = c.discs;
    options.box = c.box;
    Scenario s = worlds::generate(worlds::Kind::discs, options);
    s.robot.rangefinders.cone = c.cone;
    s.robot.rangefinders.side_angle = c.side;
    const auto hand = guard::make_operator(guard::Hand::perfect, s, seed);
    if (!hand) continue;
    const guard::Result result = guard::drive(s, *hand);
    EXPECT_NE(result.end, guard::End::contact) << "seed " << seed;
    ++drives;
    arrived += result.end == guard::End::arrived ? 1 : 0;
    path += result.path_m;
    time += result.time_s;
  }
  std::printf("%s: %d of %d arrive, %.3f m/s\n", c.name, arrived, drives, path / time);
  EXPECT_GE(arrived * 100, drives * 98);
  EXPECT_GE(path / time, c.bar_mps);
}

INSTANTIATE_TEST_SUITE_P(In, PerfectOperator,
                         testing::Values(Class{"discs", 30, false, 25_deg, 30_deg, 0.25},
                                         Class{"box", 75, true, 25_deg, 30_deg, 0.245},
                                         Class{"discs_wide", 30, false, 35_deg, 33_deg, 0.27},
                                         Class{"box_wide", 75, true, 35_deg, 33_deg, 0.265}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace whisker::test
