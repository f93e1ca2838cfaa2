// The map planner's verdict if the goal's enclosure touches the wall of a box: unreachable if closed, reached
// if it has a gap.
#include <gtest/gtest.h>

#include "host/run/narrowest_gap.hpp"
#include "host/run/runner.hpp"
#include "host/worlds/generate.hpp"
#include "host/worlds/random.hpp"
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

/// Slits around one place are not tried again and again until the supervisor reports no progress.
TEST(Enclosed, SlitsOfOnePlaceAreTriedOnce) {
  EXPECT_EQ(drive(worlds::Kind::enclosed, 400009, PlannerKind::map).verdict, Verdict::unreachable);
}

/// A gap between two obstacles of the enclosure leads no nearer to the goal.
TEST(Enclosed, AGapIsNotPassedToAndFro) {
  EXPECT_EQ(drive(worlds::Kind::enclosed, 710037, PlannerKind::skirt).verdict, Verdict::unreachable);
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
      boundary.planner = PlannerKind::skirt;
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
    run_options.planner = PlannerKind::skirt;
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
  const int without = solved(PlannerKind::skirt);
  for (const PlannerKind planner : kMaps) EXPECT_GE(solved(planner), without) << name(planner);
}

}  // namespace
}  // namespace whisker
