// A reading that is wrongly clear clears no ground, nor do two in a row after an echo, if those around them
// are right and the beam has shown before that it errs.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "firmware/perception/range_monitor.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/random.hpp"
#include "tests/effort.hpp"
#include "tests/missions/bench.hpp"
#include "tests/perception/cells.hpp"

namespace whisker::test {
namespace {

using worlds::Random;

/// Makes readings of each beam wrongly clear, one or, once it has shown that it errs, two in a row after an
/// echo, with at least kRight right ones between them.
class FewFalseClears {
  static constexpr int kRight = 4;
  static constexpr int kShown = 20;

 public:
  FewFalseClears(std::uint64_t seed, int in_a_row) : random_(seed), in_a_row_(in_a_row) {}
  void operator()(hal::RangeReadings& readings) {
    for (int i = 0; i < hal::kBeams; ++i) {
      Beam& beam = beam_[i];
      hal::RangeReading& reading = readings.beam[i];
      if (reading.status == hal::RangeStatus::stale) continue;
      if (reading.sequence != beam.sequence) {
        beam.sequence = reading.sequence;
        ++beam.since;
        const int lies = beam.lies < kShown ? 1 : in_a_row_;
        const bool may = beam.since >= lies + kRight && (in_a_row_ == 1 || beam.echo);
        if (may && random_.chance(0.3)) {
          beam.since = 0;
          ++beam.lies;
        }
        beam.echo = reading.status == hal::RangeStatus::ok;
      }
      if (beam.since < (beam.lies <= kShown ? 1 : in_a_row_)) reading.status = hal::RangeStatus::clear;
    }
  }

 private:
  struct Beam {
    std::uint8_t sequence = 0xFF;
    int since = kRight;
    int lies = 0;
    bool echo = false;
  };
  Random random_;
  int in_a_row_;
  Beam beam_[hal::kBeams];
};

double metres(Length l) { return l.raw() * 1e-6; }

/// Clear cells that overlap an obstacle by more than half a millimetre, the error of the estimate.
int overlapping(Bench& bench, double cell) {
  constexpr double kSlack = 0.0005;
  const Pose& pose = bench.status().pose;
  const Shift shift{bench.plant().pose(), {{metres(pose.at.x), metres(pose.at.y)}, radians(pose.heading)}};
  int found = 0;
  for_each_clear(*bench.local_grid(), pose, static_cast<int32_t>(cell * 1e6 + 0.5), [&](int column, int row) {
    if (occupied(square(column, row, cell, kSlack), bench.world(), shift)) ++found;
  });
  return found;
}

class FalseClears : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(InARow, FalseClears, testing::Values(1, 2));

TEST_P(FalseClears, ClearNoCellThatHoldsAnything) {
  const std::uint64_t missions = test::effort(2, 1000);
  int overlaps = 0, missions_with = 0, contacts = 0, reached = 0;
  for (std::uint64_t seed = 1; seed <= missions; ++seed) {
    worlds::Options options;
    options.seed = 81000 + seed;
    const Scenario scenario = worlds::generate(worlds::Kind::discs, options);
    const double cell = metres(grid_cell(scenario.robot));
    Bench bench(scenario, PlannerKind::boundary);
    bench.board().ranges = FewFalseClears(seed, GetParam());
    int here = 0, ticks = 0;
    while (bench.plant().time() < 300) {
      // The estimate is that of the last tick, so the true pose is taken before time passes.
      if (!bench.tick()) break;
      if (++ticks % 5 == 0) here += overlapping(bench, cell);
      bench.pass(10);
    }
    overlaps += here;
    missions_with += here > 0 ? 1 : 0;
    contacts += bench.plant().in_contact() ? 1 : 0;
    reached += bench.ended() == "reached" ? 1 : 0;
  }
  std::printf("%d missions: %d reached, %d contacts, %d overlapping cells in %d of them\n",
              static_cast<int>(missions), reached, contacts, overlaps, missions_with);
  EXPECT_EQ(overlaps, 0);
  EXPECT_EQ(contacts, 0);
  EXPECT_GE(reached, static_cast<int>(missions * 9 / 10));
}

// Rangefinders that cannot be trusted stop the robot with a named fault; usable ones do not.

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
