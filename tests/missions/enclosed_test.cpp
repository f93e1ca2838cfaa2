// The map planner's verdict if the goal's enclosure touches the wall of a box: unreachable if closed, reached
// if it has a gap.
#include <gtest/gtest.h>

#include "host/run/runner.hpp"
#include "host/worlds/generate.hpp"
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

/// In at least 97 % of the worlds.
TEST(EnclosedAtWall, IsSaidToBeUnreachable) {
  const std::uint64_t count = test::effort(3, 300);
  for (const PlannerKind planner : kMaps) {
    std::uint64_t right = 0;
    for (std::uint64_t seed = 1; seed <= count; ++seed) {
      const RunResult r = drive(worlds::Kind::enclosed_at_wall, seed, planner);
      EXPECT_TRUE(r.verdict == Verdict::unreachable || r.verdict == Verdict::gave_up)
          << seed << ": " << r.detail;
      right += r.verdict == Verdict::unreachable;
    }
    EXPECT_GE(right * 100, count * 97) << name(planner);
  }
}

TEST(GapAtWall, IsFound) {
  for (const PlannerKind planner : kMaps) {
    for (std::uint64_t seed = 1; seed <= test::effort(6, 1000); ++seed) {
      const RunResult r = drive(worlds::Kind::gap_at_wall, seed, planner);
      EXPECT_EQ(r.verdict, Verdict::reached) << name(planner) << ", " << seed << ": " << r.detail;
    }
  }
}

/// Larger than the window of any map: not worse than without a map.
TEST(ContestMaze, IsSolvedAsOftenAsWithoutAMap) {
  const std::uint64_t count = test::effort(2, 20);
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
