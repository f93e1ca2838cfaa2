#include "host/harness/worlds/reach.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/scenario/contact.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/world.hpp"
#include "host/harness/scenario/write.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/random.hpp"
#include "host/harness/worlds/scale.hpp"

namespace whisker::worlds {
namespace {

using sim::Vec2;

constexpr double kRadius = 0.125;
constexpr double kBand = 0.0283;  // sqrt(2) cells: the error that the grid may cause

/// A wall across a closed 4 m x 4 m room, with one gap, turned by any angle.
World room_with_gap(double gap, double turn, double shift) {
  const Vec2 axis{std::cos(turn), std::sin(turn)};
  const Vec2 across{-axis.y, axis.x};
  const auto at = [&](double u, double v) { return axis * u + across * v; };
  const std::vector<Vec2> corners{at(-2, -2), at(2, -2), at(2, 2), at(-2, 2)};
  World world;
  for (std::size_t i = 0; i < 4; ++i) world.segments.push_back({corners[i], corners[(i + 1) % 4]});
  world.segments.push_back({at(0, -2), at(0, shift - gap / 2)});
  world.segments.push_back({at(0, shift + gap / 2), at(0, 2)});
  return world;
}

TEST(Path, ThroughAGapIsProvenOnceItIsWideEnough) {
  for (int i = 0; i < 60; ++i) {
    const double turn = i * 0.11;
    const Vec2 from = Vec2{std::cos(turn), std::sin(turn)} * -1.0;
    const Vec2 to = from * -1.0;
    const double shift = 0.013 * i - 0.4;
    const double fits = 2 * kRadius;
    EXPECT_TRUE(path_proven(room_with_gap(fits + 2 * kBand, turn, shift), from, to, kRadius)) << i;
    EXPECT_FALSE(path_proven(room_with_gap(fits - 1e-6, turn, shift), from, to, kRadius)) << i;
    EXPECT_TRUE(path_ruled_out(room_with_gap(fits - 2 * kBand, turn, shift), from, to, 0.1, kRadius)) << i;
    EXPECT_FALSE(path_ruled_out(room_with_gap(fits + 1e-6, turn, shift), from, to, 0.1, kRadius)) << i;
  }
}

TEST(Path, BetweenDiscsDependsOnTheGapBetweenThem) {
  const auto ring = [](double gap) {
    World world;
    // Twelve discs around the origin, with this distance between neighbours.
    const double pitch = 2 * std::sin(std::acos(-1) / 12) * 2;
    for (int i = 0; i < 12; ++i) {
      const double angle = i * std::acos(-1) / 6;
      world.discs.push_back({{2 * std::cos(angle), 2 * std::sin(angle)}, (pitch - gap) / 2});
    }
    return world;
  };
  const Vec2 out{4, 1};
  EXPECT_TRUE(path_proven(ring(0.31), {0, 0}, out, kRadius));
  EXPECT_FALSE(path_proven(ring(0.2499), {0, 0}, out, kRadius));
  EXPECT_TRUE(path_ruled_out(ring(0.19), {0, 0}, out, 0.1, kRadius));
  EXPECT_FALSE(path_ruled_out(ring(0.2501), {0, 0}, out, 0.1, kRadius));
}

TEST(Path, LeadsOutOfAUAndOfASpiral) {
  World u;
  u.segments = {{{-1, 1}, {1, 1}}, {{1, 1}, {1, -1}}, {{1, -1}, {-1, -1}}};
  EXPECT_TRUE(path_proven(u, {0, 0}, {3, 0}, kRadius));
  u.segments.push_back({{-1, -1}, {-1, 1}});
  EXPECT_TRUE(path_ruled_out(u, {0, 0}, {3, 0}, 0.1, kRadius));

  World spiral;
  Vec2 corner{-0.25, -0.25};
  Vec2 way{0.5, 0};
  for (int i = 0; i < 12; ++i) {
    const Vec2 next = corner + way * (1 + i / 2);
    spiral.segments.push_back({corner, next});
    corner = next;
    way = {-way.y, way.x};
  }
  EXPECT_TRUE(path_proven(spiral, {0, 0}, {5, 5}, kRadius));
  EXPECT_TRUE(path_ruled_out(spiral, {0, 0}, {5, 5}, 0.1, 0.28));
}

TEST(Path, OutsideOfEverythingIsFoundAroundTheObstacles) {
  World world;
  world.segments = {{{0, -3}, {0, 3}}};
  EXPECT_TRUE(path_proven(world, {-1, 0}, {1, 0}, kRadius));
}

TEST(Path, FromOrToAPointInContactIsNone) {
  World world;
  world.discs = {{{0, 0}, 0.5}};
  EXPECT_FALSE(path_proven(world, {0.6, 0}, {3, 0}, kRadius));
  EXPECT_FALSE(path_proven(world, {3, 0}, {0.6, 0}, kRadius));
  EXPECT_TRUE(path_ruled_out(world, {0.6, 0}, {3, 0}, 0.1, kRadius));
  EXPECT_TRUE(path_ruled_out(world, {3, 0}, {0.3, 0}, 0.1, kRadius));
}

TEST(Path, ToAGoalBehindAWallCountsIfItsToleranceReachesThrough) {
  World world = room_with_gap(0, 0, 0);
  const double reach = kRadius + 0.05;
  EXPECT_FALSE(path_ruled_out(world, {-1, 0}, {0.05, 0}, reach, kRadius));
  EXPECT_TRUE(path_ruled_out(world, {-1, 0}, {0.05, 0}, reach - 0.05, kRadius));
}

TEST(Path, InAWorldTooLargeForTheGridIsNotAnswered) {
  EXPECT_THROW(path_proven(World{}, {0, 0}, {100, 100}, kRadius), std::length_error);
}

/// Reference: every point of a finer grid, each measured against every obstacle.
class FineGrid {
 public:
  static constexpr double kCell = 0.01;
  static constexpr int kSide = 200;
  static constexpr double kLoss = 0.00708;  // half a diagonal

  explicit FineGrid(const Scenario& s) {
    for (int i = 0; i < kSide * kSide; ++i) gaps_.push_back(nearest_obstacle(s, point(i)).distance_m);
  }
  /// Whether points with at least this clearance connect `from` to within `tolerance` of `to`.
  bool connected(Vec2 from, Vec2 to, double tolerance, double gap) const {
    std::vector<bool> seen(gaps_.size());
    std::vector<int> front;
    for (int i = 0; i < kSide * kSide; ++i) {
      if (distance(point(i), from) <= kLoss && gaps_[static_cast<std::size_t>(i)] >= gap) front.push_back(i);
    }
    while (!front.empty()) {
      const int here = front.back();
      front.pop_back();
      if (distance(point(here), to) <= tolerance) return true;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int x = here % kSide + dx;
          const int y = here / kSide + dy;
          if (x < 0 || y < 0 || x >= kSide || y >= kSide) continue;
          const auto there = static_cast<std::size_t>(y * kSide + x);
          if (seen[there] || gaps_[there] < gap) continue;
          seen[there] = true;
          front.push_back(static_cast<int>(there));
        }
      }
    }
    return false;
  }

 private:
  static double distance(Vec2 a, Vec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }
  static Vec2 point(int i) { return {(i % kSide + 0.5) * kCell, (i / kSide + 0.5) * kCell}; }
  std::vector<double> gaps_;
};

TEST(Path, AgreesWithAFinerGridInRandomWorlds) {
  int proven = 0;
  int ruled_out = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    Random random(seed);
    Scenario s;
    s.bounds = Bounds{{0, 0}, {2, 2}};
    for (int i = 0; i < 16; ++i) {
      const double x = random.uniform(0, 2);
      const double y = random.uniform(0, 2);
      if (i % 3 == 0) {
        s.walls.push_back({{x, y}, {x + random.uniform(-1, 1), y + random.uniform(-1, 1)}});
      } else {
        s.discs.push_back({{x, y}, random.uniform(0.03, 0.2)});
      }
    }
    const Vec2 from{0.3, 0.3};
    const Vec2 to{1.7, 1.7};
    const double r = random.uniform(0.06, 0.14);
    if (nearest_obstacle(s, from).distance_m < r + 0.05 || nearest_obstacle(s, to).distance_m < r + 0.05)
      continue;
    const World world = make_world(s);
    const FineGrid fine(s);
    const double loss = FineGrid::kLoss;
    if (path_proven(world, from, to, r)) {
      ++proven;
      EXPECT_TRUE(fine.connected(from, to, loss, r - loss)) << "seed " << seed;
    } else {
      EXPECT_FALSE(fine.connected(from, to, loss, r + kBand + loss)) << "seed " << seed;
    }
    const double tolerance = 0.05;
    if (path_ruled_out(world, from, to, tolerance, r)) {
      ++ruled_out;
      EXPECT_FALSE(fine.connected(from, to, tolerance, r + loss)) << "seed " << seed;
    } else {
      EXPECT_TRUE(fine.connected(from, to, tolerance + 0.0142 + loss, r - kBand - loss)) << "seed " << seed;
    }
  }
  EXPECT_GT(proven, 5);
  EXPECT_GT(ruled_out, 5);
}

Scenario generated(Kind kind, std::uint64_t seed) {
  Options options;
  options.seed = seed;
  return generate(kind, options);
}

// Not smaller: the reference robot must fit.
constexpr double kFactors[] = {1.25, 2.7301, 11.111};

TEST(AScaledWorld, OfFactorOneIsTheSame) {
  for (const Kind kind : kAllKinds) {
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
      Scenario s = generated(kind, seed);
      const std::string before = to_toml(s);
      scale_lengths(s, 1);
      EXPECT_EQ(to_toml(s), before) << name(kind);
    }
  }
}

TEST(AScaledWorld, HasEveryLengthScaled) {
  Scenario s = parse_scenario(
      "[start]\nx_m = 1\ny_m = 2\n[goal]\nx_m = 3\ny_m = 5\ntolerance_m = 0.2\n"
      "[bounds]\nmin = [-9, -8]\nmax = [9, 8]\n[[disc]]\ncenter = [4, -2]\nradius_m = 0.5\n"
      "[[polygon]]\npoints = [[5, 5], [6, 5], [6, 6]]\n[[wall]]\npoints = [[-3, 0], [-3, 2]]\n"
      "[[mover]]\ncenter = [0, -4]\nradius_m = 0.1\npath = [[0, -4], [2, -4]]\nspeed_mps = 0.3\n",
      "s");
  scale_lengths(s, 2);
  EXPECT_EQ(
      to_toml(s),
      to_toml(parse_scenario(
          "name = \"s\"\n[start]\nx_m = 2\ny_m = 4\n[goal]\nx_m = 6\ny_m = 10\ntolerance_m = 0.4\n"
          "[bounds]\nmin = [-18, -16]\nmax = [18, 16]\n[[disc]]\ncenter = [8, -4]\nradius_m = 1\n"
          "[[polygon]]\npoints = [[10, 10], [12, 10], [12, 12]]\n[[wall]]\npoints = [[-6, 0], [-6, 4]]\n"
          "[[mover]]\ncenter = [0, -8]\nradius_m = 0.2\npath = [[0, -8], [4, -8]]\nspeed_mps = 0.3\n",
          "s")));
}

TEST(AScaledWorld, StartsTowardsItsGoalAndIsExactInAFile) {
  for (const Kind kind : kAllKinds) {
    for (const double factor : kFactors) {
      Scenario s = generated(kind, 7);
      scale_lengths(s, factor);
      EXPECT_EQ(s.start.heading, bearing(s.start.at, s.goal.at));
      const std::string text = to_toml(s);
      EXPECT_EQ(to_toml(parse_scenario(text, "scaled")), text) << name(kind);
    }
  }
}

// The hand-made scenarios.

TEST(HandMadeScenarios, LoadAndHaveAPath) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(WHISKER_SOURCE_DIR "/host/worlds/scenarios")) {
    const Scenario s = load_scenario(entry.path().string());
    EXPECT_TRUE(path_proven(make_world(s), s.start.at, s.goal.at, kPassableRadius)) << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 4);
}

}  // namespace
}  // namespace whisker::worlds
