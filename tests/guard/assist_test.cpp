// How the response table bends and slows a command.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <cstdint>
#include <vector>

#include "firmware/fuzzy/response_table.hpp"
#include "firmware/safety/assist.hpp"
#include "host/worlds/random.hpp"
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

}  // namespace
}  // namespace whisker::test
