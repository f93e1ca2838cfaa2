#include "host/lab/scanner/reference_path.hpp"

#include <gtest/gtest.h>

#include "host/harness/worlds/generate.hpp"
#include "host/lab/paths/shortest.hpp"

namespace whisker::scanner {
namespace {

using sim::Vec2;

constexpr double kRadius = 0.1;
constexpr double kRange = 2;

double shortest(const World& world, Vec2 from, Vec2 to) {
  return paths::shortest_path(world, from, to, kRadius).value_or(-1);
}

/// A blind alley along x, open at -1 and closed at its end.
World alley(double end) {
  World world;
  world.segments = {{{-1, -1}, {end, -1}}, {{end, -1}, {end, 1}}, {{end, 1}, {-1, 1}}};
  return world;
}

double ratio(const ReferencePath& reference) { return reference.driven_m / reference.shortest_m.value_or(0); }

TEST(ReferencePath, AnEmptyWorldIsCrossedStraight) {
  const ReferencePath reference = drive({}, {1, 2}, {9, 8}, kRadius, kRange);
  EXPECT_TRUE(reference.reached);
  EXPECT_NEAR(reference.driven_m, 10, 1e-9);
  EXPECT_EQ(drive({}, {1, 2}, {1, 2}, kRadius, kRange).driven_m, 0);
}

TEST(ReferencePath, WhatItSeesFromTheStartCostsNoDetour) {
  World world;
  world.discs = {{{1.5, 0.1}, 0.5}};
  const ReferencePath reference = drive(world, {0, 0}, {3, 0}, kRadius, kRange);
  EXPECT_TRUE(reference.reached);
  EXPECT_NEAR(ratio(reference), 1, 0.002) << "but for what lies beyond the rim that it sees";
  EXPECT_NEAR(*reference.shortest_m, shortest(world, {0, 0}, {3, 0}), 0.004);
  const World u = alley(1);
  EXPECT_NEAR(drive(u, {-3, 0}, {2, 0}, kRadius, 9).driven_m, shortest(u, {-3, 0}, {2, 0}), 1e-4);
}

TEST(ReferencePath, GoesIntoADeadEndUntilItSeesItsEndAndOutAgain) {
  const Vec2 start{-2, 0}, goal{6, 0};
  const World world = alley(4);
  const double shown = 4 - kRange;  // the end becomes visible here, but not yet its corners
  const double least = (shown - start.x) + shortest(world, {shown, 0}, goal);
  const ReferencePath reference = drive(world, start, goal, kRadius, kRange);
  EXPECT_TRUE(reference.reached);
  EXPECT_GT(reference.driven_m, least);
  EXPECT_LT(reference.driven_m, least + 2 * 0.7);
  EXPECT_GT(reference.driven_m, 1.4 * shortest(world, start, goal));
}

TEST(ReferencePath, EndsWhereWhatItSawLeavesNoWay) {
  World world;
  world.segments = {{{4, -1}, {6, -1}}, {{6, -1}, {6, 1}}, {{6, 1}, {4, 1}}, {{4, 1}, {4, -1}}};
  const ReferencePath reference = drive(world, {0, 0}, {5, 0}, kRadius, kRange);
  EXPECT_FALSE(reference.reached);
  EXPECT_GT(reference.driven_m, 4) << "it had to see the far side";
  EXPECT_LT(reference.driven_m, 12);
}

TEST(ReferencePath, WhatTheBodyMeetsIsKnown) {
  constexpr double kBlind = kRadius / 2;
  World world;
  world.segments = {{{1, -0.5}, {1, 0.3}}};
  const ReferencePath reference = drive(world, {0, 0}, {2, 0}, kRadius, kBlind);
  EXPECT_TRUE(reference.reached);
  EXPECT_GT(reference.driven_m, shortest(world, {0.9, 0}, {2, 0}) + 0.9 - 0.02);
  EXPECT_LT(ratio(reference), 1.5);
}

struct Class {
  worlds::Kind kind;
  std::optional<int> discs;
  bool box;
};

TEST(ReferencePath, IsNeverShorterThanTheShortestWayAndAlwaysEnds) {
  for (const Class& c : {Class{worlds::Kind::discs, 30, false}, Class{worlds::Kind::discs, 75, true},
                         Class{worlds::Kind::poles, {}, false}, Class{worlds::Kind::u_trap, {}, false},
                         Class{worlds::Kind::spiral, {}, false}, Class{worlds::Kind::maze, {}, false},
                         Class{worlds::Kind::rooms, {}, false}, Class{worlds::Kind::enclosed, {}, false}}) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      worlds::Options options;
      options.seed = seed;
      options.discs = c.discs;
      options.box = c.box;
      const Scenario s = worlds::generate(c.kind, options);
      const World world = make_world(s);
      const ReferencePath reference = drive(world, s.start.at, s.goal.at, kRadius, kRange);
      EXPECT_EQ(reference.reached, c.kind != worlds::Kind::enclosed) << worlds::name(c.kind) << " " << seed;
      if (!reference.reached) continue;
      EXPECT_GE(ratio(reference), 0.999) << worlds::name(c.kind) << " " << seed;
      EXPECT_LT(ratio(reference), 4) << worlds::name(c.kind) << " " << seed;
      EXPECT_NEAR(*reference.shortest_m, shortest(world, s.start.at, s.goal.at), 0.02)
          << worlds::name(c.kind) << " " << seed;
    }
  }
}

}  // namespace
}  // namespace whisker::scanner
