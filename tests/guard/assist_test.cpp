// How the response table bends and slows a command.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "firmware/fuzzy/response_table.hpp"
#include "firmware/safety/assist.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/random.hpp"
#include "host/lab/guard/campaign.hpp"
#include "host/lab/guard/operators.hpp"
#include "tests/effort.hpp"
#include "tests/guard/bench.hpp"
#include "tests/guard/tables.hpp"

namespace whisker::test {
namespace {

using planning::VelocityRequest;

constexpr Params kRobot;
constexpr Speed kFastest = kRobot.wheels.max_turn_rate * (kRobot.body.track / 2);

struct Disc {
  Vec centre;
  Length radius;
};

/// Suspect ground where these discs are; all else is unknown.
perception::LocalGrid grid_with(const std::vector<Disc>& discs) {
  perception::LocalGrid grid;
  grid.configure(kRobot);
  grid.reset({});
  for (const Disc& disc : discs) grid.block(disc.centre, disc.radius);
  return grid;
}

VelocityRequest assisted(const VelocityRequest& asked, const std::vector<Disc>& discs,
                         const ResponseTable& table = fuzzy::kResponseTable) {
  safety::Assist assist;
  assist.use(table);
  return assist.step(asked, kFastest, {}, grid_with(discs), kRobot);
}

std::vector<Disc> random_discs(worlds::Random& random) {
  std::vector<Disc> discs;
  for (int i = random.index(6); i >= 0; --i) {
    discs.push_back({{millimetres(random.index(600) - 300), millimetres(random.index(600) - 300)},
                     millimetres(1 + random.index(60))});
  }
  return discs;
}

VelocityRequest random_request(worlds::Random& random) {
  return {Speed::from_raw(random.index(900001) - 300000), Speed::from_raw(random.index(420001) - 210000),
          true};
}

const std::vector<Disc> kAheadOnTheLeft{{{millimetres(220), millimetres(60)}, 40_mm}};

TEST(Assist, ChangesNothingOnOpenGround) {
  const VelocityRequest bent = assisted({300_mm_per_s, 20_mm_per_s, true}, {});
  EXPECT_EQ(bent.forward, 300_mm_per_s);
  EXPECT_EQ(bent.turning, 20_mm_per_s);
}

TEST(Assist, TurnsToTheFreerSideAndSlows) {
  const VelocityRequest bent = assisted({300_mm_per_s, {}, true}, kAheadOnTheLeft);
  EXPECT_LT(bent.turning, -20_mm_per_s);
  EXPECT_LT(bent.forward, 300_mm_per_s);
  EXPECT_GT(bent.forward, 50_mm_per_s);
}

TEST(Assist, BendsASlowCommandInProportion) {
  const Speed fast = assisted({300_mm_per_s, {}, true}, kAheadOnTheLeft).turning;
  const Speed slow = assisted({100_mm_per_s, {}, true}, kAheadOnTheLeft).turning;
  EXPECT_NEAR(slow.raw() * 3, fast.raw(), 10);
}

TEST(Assist, AskedTurningAndBendAddUp) {
  const Speed bend = assisted({300_mm_per_s, {}, true}, kAheadOnTheLeft).turning;
  EXPECT_EQ(assisted({300_mm_per_s, 30_mm_per_s, true}, kAheadOnTheLeft).turning, bend + 30_mm_per_s);
}

TEST(Assist, SomethingBehindOrBesideDoesNotMatter) {
  const VelocityRequest asked{300_mm_per_s, {}, true};
  EXPECT_EQ(assisted(asked, {{{-200_mm, 20_mm}, 40_mm}}).turning, Speed{});
  EXPECT_EQ(assisted(asked, {{{-100_mm, 150_mm}, 20_mm}}).turning, Speed{});
}

TEST(Assist, ATableThatSaysNothingChangesNothing) {
  const ResponseTable table = constant(Q14{}, Q14::ratio(1, 1));
  const VelocityRequest bent = assisted({300_mm_per_s, 20_mm_per_s, true}, kAheadOnTheLeft, table);
  EXPECT_EQ(bent.forward, 300_mm_per_s);
  EXPECT_EQ(bent.turning, 20_mm_per_s);
}

TEST(Assist, ANegativeStepStands) {
  const ResponseTable table = constant(Q14{}, Q14::ratio(-1, 1));
  EXPECT_EQ(assisted({300_mm_per_s, {}, true}, {}, table).forward, Speed{});
}

/// The same discs at centres of cells: the grid rounds others, and not as it rounds their mirror images.
std::vector<Disc> on_cells(std::vector<Disc> discs) {
  const int32_t cell = 2 * grid_with({}).half_window().raw() / perception::kCells;
  const auto centre = [cell](Length x) { return Length::from_raw(x.raw() / cell * cell + cell / 2); };
  for (Disc& disc : discs) disc.centre = {centre(disc.centre.x), centre(disc.centre.y)};
  return discs;
}

RC_GTEST_PROP(Assist, MirrorsInAMirroredWorld, (std::uint64_t seed)) {
  worlds::Random random(seed);
  std::vector<Disc> discs = on_cells(random_discs(random));
  const VelocityRequest asked = random_request(random);
  const VelocityRequest bent = assisted(asked, discs);
  for (Disc& disc : discs) disc.centre.y = -disc.centre.y;
  const VelocityRequest mirrored = assisted({asked.forward, -asked.turning, true}, discs);
  RC_ASSERT(mirrored.forward == bent.forward);
  RC_ASSERT(mirrored.turning == -bent.turning);
}

RC_GTEST_PROP(Assist, NeverAsksForMoreWhateverTheTableSays, (std::uint64_t seed)) {
  worlds::Random random(seed);
  const ResponseTable table = random_table(random);
  const VelocityRequest asked = random_request(random);
  const VelocityRequest bent = assisted(asked, random_discs(random), table);
  if (asked.forward <= Speed{}) {
    RC_ASSERT(bent.forward == asked.forward);
    RC_ASSERT(bent.turning == asked.turning);
  } else {
    RC_ASSERT(bent.forward <= asked.forward);
    RC_ASSERT(bent.forward >= Speed{});
    RC_ASSERT(abs(bent.turning) <= max(abs(asked.turning), kFastest));
  }
  const VelocityRequest stands = assisted({}, random_discs(random), table);
  RC_ASSERT(!stands.moves);
  RC_ASSERT(stands.forward == Speed{});
  RC_ASSERT(stands.turning == Speed{});
}

// The guard with its assist: it does not stand before what it can pass, and the promise does not rest on it.

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
