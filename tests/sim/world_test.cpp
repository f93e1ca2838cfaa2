#include "host/harness/sim/world.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ios>
#include <limits>
#include <vector>

#include "host/harness/sim/distance.hpp"
#include "tests/sim/generators.hpp"
#include "tests/sim/scripted_drive.hpp"

namespace whisker::sim {
namespace {

TEST(MovingDisc, RunsThereAndBackForEver) {
  const Vec2 path[] = {{0, 0}, {3, 0}, {3, 1}};
  const MovingDisc mover{path, 3, 0.1, 0.5, 0};
  const struct {
    double t, x, y;
  } expected[] = {{0, 0, 0},   {2, 1, 0},  {6, 3, 0},    {7, 3, 0.5}, {8, 3, 1},
                  {9, 3, 0.5}, {10, 3, 0}, {15, 0.5, 0}, {16, 0, 0},  {1618, 1, 0}};
  for (const auto& e : expected) {
    EXPECT_NEAR(position(mover, e.t).x, e.x, 1e-12) << e.t;
    EXPECT_NEAR(position(mover, e.t).y, e.y, 1e-12) << e.t;
  }
}

TEST(MovingDisc, StartsWhereItsArcSays) {
  const Vec2 path[] = {{0, 0}, {3, 0}, {3, 1}};
  const Vec2 p = position({path, 3, 0.1, 0.5, 3.25}, 0);
  EXPECT_DOUBLE_EQ(p.x, 3);
  EXPECT_DOUBLE_EQ(p.y, 0.25);
}

TEST(MovingDisc, StandsStillOnAPathOfNoLength) {
  const Vec2 path[] = {{1, 2}, {1, 2}};
  for (const std::size_t count : {1U, 2U}) {
    EXPECT_EQ(position({path, count, 0.1, 5, 0}, 7.3).x, 1);
    EXPECT_EQ(position({path, count, 0.1, 5, 0}, 7.3).y, 2);
  }
}

TEST(MovingDisc, NeverOutrunsItsSpeed) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Vec2> path;
    const int n = *rc::gen::inRange(1, 6);
    for (int i = 0; i < n; ++i) path.push_back(point(2));
    const MovingDisc mover{path.data(), path.size(), 0.1, real(0, 2), real(0, 3)};
    const double t = real(0, 50), dt = real(0, 3);
    const Vec2 moved = position(mover, t + dt) - position(mover, t);
    RC_ASSERT(std::hypot(moved.x, moved.y) <= mover.speed * dt + 1e-9);
    // It stays on its path.
    double off = std::hypot(position(mover, t).x - path[0].x, position(mover, t).y - path[0].y);
    for (std::size_t i = 1; i < path.size(); ++i) {
      off = std::fmin(off, distance(position(mover, t), {path[i - 1], path[i]}));
    }
    RC_ASSERT(off < 1e-9);
  }));
}

TEST(Clearance, OfAnEmptyWorldIsInfinite) {
  EXPECT_EQ(clearance({}, {0, 0}, 0, 0.09), std::numeric_limits<double>::infinity());
}

TEST(Clearance, DeepInsideOneDiscASmallOneDoesNotMatter) {
  const Disc discs[] = {{{0, 0}, 1}, {{0.1, 0}, 0.01}};
  EXPECT_DOUBLE_EQ(clearance({discs, 2, nullptr, 0, nullptr, 0}, {0, 0}, 0, 0.09), -1.09);
}

TEST(Clearance, IsTheLeastDistanceLessTheBodysRadius) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Disc> discs;
    std::vector<Segment> segments;
    const std::size_t n = *rc::gen::inRange<std::size_t>(0, 8);
    for (std::size_t i = 0; i < n; ++i) {
      discs.push_back({point(3), real(0.01, 1)});
      segments.push_back({point(3), point(3)});
    }
    const std::vector<Vec2> path{point(3), point(3)};
    const MovingDisc movers[] = {{path.data(), 2, real(0.01, 0.5), real(0, 1), 0}};
    const std::size_t moving = *rc::gen::inRange<std::size_t>(0, 2);
    const Vec2 p = point(3);
    const double t = real(0, 20), radius = real(0.02, 0.5);

    double expected = std::numeric_limits<double>::infinity();
    for (const Disc& d : discs) expected = std::fmin(expected, signed_distance(p, d));
    for (const Segment& s : segments) expected = std::fmin(expected, distance(p, s));
    if (moving == 1)
      expected = std::fmin(expected, signed_distance(p, {position(movers[0], t), movers[0].radius}));
    const double got = clearance({discs.data(), n, segments.data(), n, movers, moving}, p, t, radius);
    RC_ASSERT(got == expected - radius || std::fabs(got - (expected - radius)) < 1e-12);
  }));
}

// golden.txt: one seed and its hash per line. A change there changes every simulated run, so it must be
// intended.
TEST(Golden, TheScriptedDriveComesOutTheSameEverywhere) {
  std::ifstream golden(std::filesystem::path(WHISKER_SOURCE_DIR) / "tests/sim/golden.txt");
  std::uint64_t seed = 0, hash = 0;
  int lines = 0;
  while (golden >> std::dec >> seed >> std::hex >> hash) {
    EXPECT_EQ(scripted_drive(seed), hash)
        << "seed " << seed << std::hex << " gives 0x" << scripted_drive(seed);
    ++lines;
  }
  EXPECT_EQ(lines, 2);
}

TEST(Golden, TheSameSeedGivesTheSameBits) { EXPECT_EQ(scripted_drive(77), scripted_drive(77)); }

TEST(Golden, AnotherSeedGivesOtherBits) { EXPECT_NE(scripted_drive(77), scripted_drive(78)); }

}  // namespace
}  // namespace whisker::sim
