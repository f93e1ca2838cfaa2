// A reading that is wrongly clear clears no ground, if the adjacent readings are right.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>

#include "host/run/spec.hpp"
#include "host/worlds/generate.hpp"
#include "host/worlds/random.hpp"
#include "tests/effort.hpp"
#include "tests/missions/bench.hpp"
#include "tests/perception/cells.hpp"

namespace whisker::test {
namespace {

using worlds::Random;

/// Makes readings of each beam wrongly clear, with at least five between two of them.
class LoneFalseClears {
 public:
  explicit LoneFalseClears(std::uint64_t seed) : random_(seed) {}
  void operator()(hal::RangeReadings& readings) {
    for (int i = 0; i < hal::kBeams; ++i) {
      Beam& beam = beam_[i];
      hal::RangeReading& reading = readings.beam[i];
      if (reading.status == hal::RangeStatus::stale) continue;
      if (reading.sequence != beam.sequence) {
        beam.sequence = reading.sequence;
        ++beam.since;
        beam.lies = beam.since >= 5 && random_.chance(0.3);
        if (beam.lies) beam.since = 0;
      }
      if (beam.lies) reading.status = hal::RangeStatus::clear;
    }
  }

 private:
  struct Beam {
    std::uint8_t sequence = 0xFF;
    int since = 0;
    bool lies = false;
  };
  Random random_;
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

TEST(LoneFalseClears, ClearNoCellThatHoldsAnything) {
  const std::uint64_t missions = test::effort(2, 1000);
  int overlaps = 0, missions_with = 0, contacts = 0, reached = 0;
  for (std::uint64_t seed = 1; seed <= missions; ++seed) {
    worlds::Options options;
    options.seed = 81000 + seed;
    const Scenario scenario = worlds::generate(worlds::Kind::discs, options);
    const double cell = metres(patch_cell(scenario.robot));
    Bench bench(scenario, PlannerKind::skirt);
    bench.board().ranges = LoneFalseClears(seed);
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

}  // namespace
}  // namespace whisker::test
