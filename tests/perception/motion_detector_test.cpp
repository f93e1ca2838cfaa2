#include <gtest/gtest.h>

#include <cstdio>

#include "host/harness/worlds/generate.hpp"
#include "tests/effort.hpp"
#include "tests/perception/rig.hpp"

namespace whisker::test {
namespace {

// Static obstacles never look like moving ones.
TEST(MotionDetector, IsNeverContradictedByAWorldAtRest) {
  int ticks = 0;
  for (const worlds::Kind kind : worlds::kKinds) {
    for (std::uint64_t seed = 1; seed <= test::effort(8); ++seed) {
      worlds::Options options;
      options.seed = 40 + seed;
      Rig rig(worlds::generate(kind, options));
      while (rig.plant().time() < 60 && rig.step()) {
        ++ticks;
        ASSERT_FALSE(rig.local_grid()->doubting())
            << worlds::name(kind) << " seed " << options.seed << " at " << rig.plant().time() << " s";
      }
    }
  }
  EXPECT_GT(ticks, static_cast<int>(test::effort(40000)));
}

/// Number of ticks, and of ticks with doubt, in noisy static worlds.
struct Doubts {
  int ticks = 0;
  int doubting = 0;
  int begun = 0;
};

Doubts drive_noisy(worlds::Kind kind, bool odometry) {
  Doubts d;
  for (std::uint64_t seed = 1; seed <= test::effort(8); ++seed) {
    worlds::Options options;
    options.seed = 60 + seed;
    options.noise = true;
    Scenario scenario = worlds::generate(kind, options);
    if (!odometry) scenario.noise.wheel_scale_sigma = scenario.noise.heading_drift_deg_per_sqrt_m = 0;
    Rig rig(scenario);
    bool before = false;
    while (rig.plant().time() < 60 && rig.step()) {
      const bool now = rig.local_grid()->doubting();
      ++d.ticks;
      d.doubting += now ? 1 : 0;
      d.begun += now && !before ? 1 : 0;
      before = now;
    }
  }
  std::printf("%s%s: %.0f s, doubted %d times, %.2f %% of the time\n", worlds::name(kind),
              odometry ? "" : ", odometry without error", d.ticks * 0.01, d.begun,
              100.0 * d.doubting / d.ticks);
  return d;
}

// Outliers do not either: 1 % of the readings miss the obstacle, 2 % are lost, and all are off by 1 cm.
TEST(MotionDetector, IsRarelyContradictedByNoise) {
  for (const worlds::Kind kind : {worlds::Kind::discs, worlds::Kind::rooms}) {
    const Doubts ranges = drive_noisy(kind, false);
    EXPECT_LT(ranges.doubting, ranges.ticks / 100);
    const Doubts all = drive_noisy(kind, true);
    EXPECT_LT(all.doubting, all.ticks / 20);
  }
}

/// Side beams that point 5 degrees farther outward contradict ground that nothing has entered. From the sixth
/// time on, that is taken for what it is, and the robot brakes for nothing.
TEST(MotionDetector, MisaimedBeamsAreNotTakenForMovingObjectsForLong) {
  int begun = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    worlds::Options options;
    options.seed = 170000 + seed;
    Scenario scenario = worlds::generate(worlds::Kind::rooms, options);
    scenario.sensor.skew_deg = 5;
    Rig rig(scenario);
    bool before = false;
    while (rig.plant().time() < 300 && rig.step()) {
      const bool now = rig.local_grid()->doubting();
      begun += now && !before ? 1 : 0;
      before = now;
    }
  }
  std::printf("doubted %d times\n", begun);
  EXPECT_LT(begun, 4 * 8);
}

}  // namespace
}  // namespace whisker::test
