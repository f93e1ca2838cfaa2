// The map planner's verdict if the goal's enclosure touches the wall of a box: unreachable if closed, reached
// if it has a gap.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "host/harness/run/narrowest_gap.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/sim/elementary.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/random.hpp"
#include "tests/effort.hpp"

namespace whisker {
namespace {

constexpr PlannerKind kMaps[] = {PlannerKind::map, core_planner("map", 16384)};

RunResult drive(worlds::Kind kind, std::uint64_t seed, PlannerKind planner) {
  worlds::Options options;
  options.seed = seed;
  RunOptions run_options;
  run_options.planner = planner;
  return run(worlds::generate(kind, options), run_options);
}

/// In at least 95 % of the worlds.
TEST(EnclosedAtWall, IsSaidToBeUnreachable) {
  const std::uint64_t count = test::effort(1, 300);
  for (const PlannerKind planner : kMaps) {
    std::uint64_t right = 0;
    for (std::uint64_t seed = 1; seed <= count; ++seed) {
      const RunResult r = drive(worlds::Kind::enclosed_at_wall, seed, planner);
      EXPECT_TRUE(r.verdict == Verdict::unreachable || r.verdict == Verdict::gave_up)
          << seed << ": " << r.detail;
      right += r.verdict == Verdict::unreachable;
    }
    EXPECT_GE(right, count * 95 / 100) << name(planner);
  }
}

TEST(GapAtWall, IsFound) {
  for (const PlannerKind planner : kMaps) {
    for (std::uint64_t seed = 1; seed <= test::effort(1, 1000); ++seed) {
      const RunResult r = drive(worlds::Kind::gap_at_wall, seed, planner);
      EXPECT_EQ(r.verdict, Verdict::reached) << name(planner) << ", " << seed << ": " << r.detail;
    }
  }
}

/// Slits around one place are not tried again and again until the supervisor reports no progress. Whether the
/// loop closes within the time limit depends on millimetres.
TEST(Enclosed, SlitsOfOnePlaceAreTriedOnce) {
  EXPECT_NE(drive(worlds::Kind::enclosed, 400009, PlannerKind::map).verdict, Verdict::fault);
}

/// A gap between two obstacles of the enclosure leads no nearer to the goal.
TEST(Enclosed, AGapIsNotPassedToAndFro) {
  EXPECT_EQ(drive(worlds::Kind::enclosed, 710037, PlannerKind::boundary).verdict, Verdict::unreachable);
}

/// What the body turns in front of slits is no lap around another obstacle.
TEST(Enclosed, LooksIntoSlitsAreNoLaps) {
  EXPECT_EQ(drive(worlds::Kind::enclosed, 2046074, PlannerKind::boundary).verdict, Verdict::unreachable);
}

/// A closed pentagon in a box: between its lowest corner and the wall is a gap that the body passes on some
/// loops only; which ones depends on millimetres.
Scenario pocket() {
  Scenario s;
  s.time_limit_s = 1800;
  s.start = {{0.8865242085126308, 0.7006332282981922}, 0.0049835};
  s.goal.at = {-1.6729274051091234, -2.177661173690111};
  s.bounds = Bounds{{-3.11993415, -3.14106873}, {3.11993415, 3.14106873}};
  s.walls = {{{-1.797374195677733, -2.9007455623988805},
              {-0.695385107283333, -2.6922996722239434},
              {-1.1488900470921584, -1.6674323788015435},
              {-2.090042450889265, -1.3312864574809362},
              {-2.581671663606839, -2.309186753266264},
              {-1.797374195677733, -2.9007455623988805}}};
  return s;
}

TEST(ClosedPolygon, WithAGapToTheWallIsNotCircledForEver) {
  RunOptions options;
  for (const PlannerKind planner : {PlannerKind::boundary, PlannerKind::map}) {
    options.planner = planner;
    const RunResult r = run(pocket(), options);
    EXPECT_EQ(r.verdict, Verdict::unreachable) << name(planner) << ": " << r.detail;
  }
}

/// Around the goal, 3 to 9 corners, in a box that leaves a gap of about a body beside it.
Scenario closed_polygon(std::uint64_t seed) {
  worlds::Random random(seed);
  const int corners = 3 + static_cast<int>(seed % 7);
  std::vector<sim::Vec2> points;
  double most = 0;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * sim::kPi * (i + random.uniform(-0.3, 0.3)) / corners;
    const double radius = random.uniform(0.4, 1.2);
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    most = std::fmax(most, std::fmax(std::fabs(points.back().x), std::fabs(points.back().y)));
  }
  points.push_back(points.front());
  Scenario s;
  s.time_limit_s = 1800;
  const double wall = most + random.uniform(0.18, 0.34);
  s.bounds = Bounds{{-wall, -wall}, {wall + 1.5, wall + 1.5}};
  s.start = {{wall + 1, wall + random.uniform(0.3, 1.2)}, -2};
  s.walls = {points};
  return s;
}

/// Looping without a verdict: at most one in 300.
TEST(ClosedPolygon, IsSaidToBeUnreachable) {
  const std::uint64_t count = test::effort(4, 300);
  std::uint64_t gave_up = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    RunOptions options;
    options.planner = PlannerKind::boundary;
    const Verdict verdict = run(closed_polygon(seed), options).verdict;
    EXPECT_TRUE(verdict == Verdict::unreachable || verdict == Verdict::gave_up) << seed;
    gave_up += verdict == Verdict::gave_up;
  }
  EXPECT_LE(gave_up, count / 300);
}

/// What the verdict names as the narrowest gap that it would have taken: wider ones are taken.
TEST(Gap, IsTakenFromTheNamedWidthOn) {
  worlds::Random random(1);
  const double named = narrowest_gap_m(Params{});
  for (std::uint64_t seed = 1; seed <= test::effort(1, 1000); ++seed) {
    for (const worlds::Kind kind : {worlds::Kind::gap, worlds::Kind::disc_gap}) {
      worlds::Options options;
      options.seed = seed;
      options.gap_m = named * random.uniform(1, 1.5);
      const RunResult wide = run(worlds::generate(kind, options), {});
      EXPECT_EQ(wide.verdict, Verdict::reached) << *options.gap_m << " m, seed " << seed;
    }
  }
}

/// Narrower ones are taken on a lane, or at least without contact.
TEST(Gap, NarrowerThanNamedIsPassedOnALane) {
  for (const worlds::Kind kind : {worlds::Kind::gap, worlds::Kind::disc_gap}) {
    const std::uint64_t count = test::effort(1, 1000);
    std::uint64_t reached = 0;
    for (std::uint64_t seed = 1; seed <= count; ++seed) {
      worlds::Options options;
      options.seed = seed;
      options.gap_m = 0.225;
      RunOptions boundary;
      boundary.planner = PlannerKind::boundary;
      const RunResult r = run(worlds::generate(kind, options), boundary);
      EXPECT_TRUE(r.verdict == Verdict::reached || r.verdict == Verdict::unreachable) << r.detail;
      EXPECT_EQ(r.unreachable_above_m.has_value(), r.verdict == Verdict::unreachable);
      EXPECT_GT(r.unreachable_above_m.value_or(1), *options.gap_m);
      if (r.verdict == Verdict::reached) ++reached;
    }
    EXPECT_GE(100 * reached, 97 * count);
  }
}

/// A gap of 1.25 diameters between the two places where the loops in both directions close, and one whose
/// jambs appear in the side beams while the body creeps.
TEST(Gap, OnTheSeamOfBothLoopsIsPassed) {
  for (const std::uint64_t seed : {1330018U, 1330041U, 1330003U, 1330008U}) {
    worlds::Options options;
    options.seed = seed;
    options.gap_m = 0.225;
    RunOptions run_options;
    run_options.planner = PlannerKind::boundary;
    const RunResult r = run(worlds::generate(worlds::Kind::gap, options), run_options);
    EXPECT_EQ(r.verdict, Verdict::reached) << seed << ": " << r.detail;
  }
}

/// Larger than the window of any map: not worse than without a map.
TEST(ContestMaze, IsSolvedAsOftenAsWithoutAMap) {
  const std::uint64_t count = test::effort(1, 20);
  const auto solved = [&](PlannerKind planner) {
    int n = 0;
    for (std::uint64_t seed = 1; seed <= count; ++seed) {
      n += drive(worlds::Kind::contest_maze, seed, planner).verdict == Verdict::reached;
    }
    return n;
  };
  const int without = solved(PlannerKind::boundary);
  for (const PlannerKind planner : kMaps) EXPECT_GE(solved(planner), without) << name(planner);
}

}  // namespace
}  // namespace whisker
