// The guard with its assist: it does not stand before what it can pass, and the promise does not rest on it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>

#include "host/guard/campaign.hpp"
#include "host/guard/operators.hpp"
#include "host/worlds/generate.hpp"
#include "tests/effort.hpp"
#include "tests/guard/bench.hpp"
#include "tests/guard/tables.hpp"

namespace whisker::test {
namespace {

constexpr Velocity kForwards{300_mm_per_s, {}};

/// A long wall ahead that the body would meet at this angle from its normal.
Scenario wall_at_angle(double angle, bool assist) {
  Scenario s;
  s.goal.at = {100, 0};
  const sim::Vec2 at{0.6, 0}, along{-std::sin(angle), std::cos(angle)};
  s.walls.push_back({at + along * -20, at + along * 20});
  s.robot.guard.assist = assist ? Fitted::yes : Fitted::no;
  return s;
}

double driven_along_wall(double angle, bool assist) {
  GuardBench bench(wall_at_angle(angle, assist));
  bench.guard.vouch(350_mm);
  bench.drive(kForwards, 15);
  EXPECT_FALSE(bench.plant.in_contact());
  return bench.plant.path_length();
}

TEST(GuardAssist, CreepsAlongAWallInsteadOfStandingBeforeIt) {
  for (const double degrees : {-60.0, -35.0, -20.0, -10.0, 10.0, 20.0, 35.0, 60.0}) {
    EXPECT_LT(driven_along_wall(degrees * M_PI / 180, false), 1) << degrees;
    EXPECT_GT(driven_along_wall(degrees * M_PI / 180, true), 1.5) << degrees;
  }
}

TEST(GuardAssist, SaysThatItAssists) {
  GuardBench bench(wall_at_angle(0.6, true));
  bench.guard.vouch(350_mm);
  bool told = false;
  for (int i = 0; i < 500; ++i) told |= bench.drive(kForwards, 0.01).reason == GuardReason::assisted;
  EXPECT_TRUE(told);
}

TEST(GuardAssist, DoesNotMoveABodyThatIsToldToStand) {
  GuardBench bench(wall_at_angle(0.6, true));
  bench.guard.vouch(350_mm);
  bench.drive(kForwards, 2);
  bench.drive({}, 1);
  const sim::Pose at = bench.plant.pose();
  bench.drive({}, 3);
  EXPECT_NEAR(bench.plant.pose().heading, at.heading, 1e-4);
  EXPECT_NEAR(bench.plant.pose().at.x, at.at.x, 1e-4);
}

TEST(GuardAssist, WithATableThatSaysNothingEveryDriveIsThatWithoutIt) {
  const ResponseTable nothing = constant(Q14{}, Q14::ratio(1, 1));
  Params off;
  off.guard.assist = Fitted::no;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(guard::hostile_drive(seed, true, {}, &nothing).hash, guard::hostile_drive(seed, true, off).hash)
        << "seed " << seed;
    EXPECT_EQ(guard::hostile_drive(seed, true, off, &nothing).hash,
              guard::hostile_drive(seed, true, off).hash);
  }
}

TEST(GuardAssist, TouchesNothingWithAnyTable) {
  const auto count = test::effort(50, 10000);
  double path = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    worlds::Random random(seed);
    const ResponseTable table = random_table(random);
    const guard::Result result = guard::hostile_drive(seed, seed % 2 == 0, {}, &table);
    EXPECT_NE(result.end, guard::End::contact) << "seed " << seed << " at " << result.time_s << " s";
    path += result.path_m;
  }
  std::printf("%llu drives by random tables from seed 1: %.0f m\n", static_cast<unsigned long long>(count),
              path);
  EXPECT_GT(path, static_cast<double>(count) * 0.15);
}

struct SloppyIn {
  const char* name;
  int discs;
  bool box;
  int least;  // per cent that arrive with assist
};
void PrintTo(const SloppyIn& c, std::ostream* out) { *out << c.name; }

struct Count {
  int drives = 0, arrived = 0;
};

Count sloppy(const SloppyIn& c, Fitted assist) {
  Count count;
  for (std::uint64_t seed = 5001; seed < 5001 + test::effort(9, 300); ++seed) {
    worlds::Options options;
    options.seed = seed;
    options.discs = c.discs;
    options.box = c.box;
    Scenario s = worlds::generate(worlds::Kind::discs, options);
    s.robot.guard.assist = assist;
    const auto hand = guard::make_operator(guard::Hand::sloppy, s, seed);
    if (!hand) continue;
    guard::Options drive;
    drive.time_s = 120;
    const guard::Result result = guard::drive(s, *hand, drive);
    EXPECT_NE(result.end, guard::End::contact) << "seed " << seed;
    ++count.drives;
    count.arrived += result.end == guard::End::arrived ? 1 : 0;
  }
  return count;
}

class SloppyOperator : public testing::TestWithParam<SloppyIn> {};

TEST_P(SloppyOperator, ArrivesWithTheTableAndMostlyNotWithout) {
  const SloppyIn& c = GetParam();
  const Count with = sloppy(c, Fitted::yes), without = sloppy(c, Fitted::no);
  std::printf("%s from seed 5001: %d of %d arrive with assist, %d without\n", c.name, with.arrived,
              with.drives, without.arrived);
  EXPECT_GE(with.arrived * 100, with.drives * c.least);
  EXPECT_LE(without.arrived * 100, without.drives * 60) << "the premise";
}

INSTANTIATE_TEST_SUITE_P(In, SloppyOperator,
                         testing::Values(SloppyIn{"discs", 30, false, 90}, SloppyIn{"box", 75, true, 75}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace whisker::test
