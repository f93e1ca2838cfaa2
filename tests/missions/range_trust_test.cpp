// Rangefinders that cannot be trusted stop the robot with a named fault; usable ones do not.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "firmware/perception/range_monitor.hpp"
#include "host/run/runner.hpp"
#include "host/scenario/scenario.hpp"
#include "host/worlds/generate.hpp"
#include "tests/missions/bench.hpp"

namespace whisker::test {
namespace {

constexpr std::uint64_t kSeed = 170001;

Scenario world(worlds::Kind kind, std::uint64_t seed = kSeed) {
  worlds::Options options;
  options.seed = seed;
  return worlds::generate(kind, options);
}

void swap_side_beams(hal::RangeReadings& readings) {
  std::swap(readings.beam[hal::kLeft], readings.beam[hal::kRight]);
}

TEST(RangeTrust, IdealSensorsAreTrusted) {
  for (const worlds::Kind kind : {worlds::Kind::discs, worlds::Kind::rooms}) {
    Bench bench(world(kind), kDefaultPlanner);
    bench.run(600);
    EXPECT_EQ(bench.ended(), "reached");
    const RangeTrust& trust = bench.status().health.ranges;
    EXPECT_EQ(trust.level, RangeLevel::trusted);
    EXPECT_EQ(trust.contradictions, 0);
  }
}

TEST(RangeTrust, SwappedSideBeamsStopTheRobot) {
  for (std::uint64_t seed = kSeed; seed < kSeed + 4; ++seed) {
    Bench bench(world(worlds::Kind::rooms, seed), kDefaultPlanner);
    bench.board().ranges = swap_side_beams;
    bench.run(600);
    EXPECT_EQ(bench.status().health.fault, Fault::range_untrusted) << seed;
    for (int i = 0; i < 100; ++i) bench.step(10);
    EXPECT_FALSE(bench.plant().in_contact()) << seed;
    EXPECT_EQ(bench.status().command.left, 0);
    EXPECT_EQ(bench.status().command.right, 0);
  }
}

/// Ends of missions with this sensor, by their details.
std::map<std::string, int> ends(worlds::Kind kind, const Sensor& sensor) {
  std::map<std::string, int> ends;
  for (std::uint64_t seed = kSeed; seed < kSeed + 6; ++seed) {
    Scenario scenario = world(kind, seed);
    scenario.sensor = sensor;
    const RunResult result = run(scenario);
    ++ends[result.detail];
    EXPECT_EQ(result.detail == "range_untrusted", result.ranges->level == RangeLevel::untrusted);
  }
  return ends;
}

TEST(RangeTrust, DoubledDistancesStopTheRobot) {
  Sensor sensor;
  sensor.scale = 2;
  EXPECT_GE(ends(worlds::Kind::rooms, sensor)["range_untrusted"], 2);
}

TEST(RangeTrust, SideBeamsThatPointFarOutwardsStopTheRobot) {
  Sensor sensor;
  sensor.skew_deg = 25;
  EXPECT_GE(ends(worlds::Kind::rooms, sensor)["range_untrusted"], 3);
}

TEST(RangeTrust, SharesDoubtAndStopButPhantomsDoNotSlow) {
  constexpr int kPercent = 656;
  perception::RangeMonitor monitor;
  monitor.configure({});
  const auto level = [&](int phantoms, int false_clears) {
    monitor.judge(static_cast<std::uint16_t>(phantoms * kPercent),
                  static_cast<std::uint16_t>(false_clears * kPercent));
    return monitor.trust().level;
  };
  EXPECT_EQ(level(15, 15), RangeLevel::trusted);
  EXPECT_EQ(level(30, 0), RangeLevel::doubtful);
  EXPECT_FALSE(monitor.slows());
  EXPECT_EQ(level(0, 30), RangeLevel::doubtful);
  EXPECT_TRUE(monitor.slows());
  EXPECT_EQ(level(70, 0), RangeLevel::untrusted);
  EXPECT_EQ(level(0, 60), RangeLevel::untrusted);
}

TEST(RangeTrust, ContradictionsFadeOverThePath) {
  perception::RangeMonitor monitor;
  monitor.configure({});
  Vec at;
  const auto drive = [&](int steps, bool contradicted) {
    for (int i = 0; i < steps; ++i) {
      at.x += 21_mm;
      monitor.move_to(at);
      if (contradicted) monitor.contradict(false);
      if (contradicted) monitor.contradict(false);  // the same step
    }
    monitor.judge(0, 0);
    return monitor.trust().level;
  };
  EXPECT_EQ(drive(10, true), RangeLevel::trusted);
  EXPECT_EQ(drive(6, true), RangeLevel::doubtful);
  EXPECT_EQ(drive(40, true), RangeLevel::untrusted);
  EXPECT_EQ(drive(150, false), RangeLevel::doubtful);
  EXPECT_EQ(drive(300, false), RangeLevel::trusted);
}

TEST(RangeTrust, TheIncidenceSeenApproachesTheLimitOfTheSensorsFromBelow) {
  for (const double limit_deg : {40.0, 50.0}) {
    Scenario scenario = world(worlds::Kind::rooms, 150003);
    scenario.sensor.incidence_deg = limit_deg;
    const RunResult result = run(scenario);
    ASSERT_TRUE(result.ranges);
    EXPECT_GT(result.ranges->incidence_deg, limit_deg - 12);
    EXPECT_LT(result.ranges->incidence_deg, limit_deg + 2);
  }
  const RunResult ideal = run(world(worlds::Kind::rooms, 150003));
  EXPECT_GT(ideal.ranges->incidence_deg, 55);
}

TEST(RangeTrust, ResetForgetsTheJudgement) {
  Bench bench(world(worlds::Kind::rooms), kDefaultPlanner);
  bench.board().ranges = swap_side_beams;
  bench.run(600);
  ASSERT_EQ(bench.status().health.fault, Fault::range_untrusted);
  bench.robot().reset();
  bench.board().ranges = nullptr;
  for (int i = 0; i < 100; ++i) bench.step(10);
  EXPECT_EQ(bench.status().health.fault, Fault::none);
  EXPECT_EQ(bench.status().health.ranges.level, RangeLevel::trusted);
}

}  // namespace
}  // namespace whisker::test
