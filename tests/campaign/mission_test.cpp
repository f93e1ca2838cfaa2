#include "host/campaign/mission.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "host/campaign/row_file.hpp"
#include "host/paths/shortest.hpp"
#include "host/run/runner.hpp"
#include "host/scenario/world.hpp"
#include "host/worlds/generate.hpp"

namespace whisker::campaign {
namespace {

const std::atomic<bool> kOn{false};

Scenario scenario(std::uint64_t seed) {
  worlds::Options options;
  options.seed = seed;
  options.discs = 15;
  options.noise = seed % 2 == 0;
  return worlds::generate(worlds::Kind::discs, options);
}

TEST(Mission, TheRowTellsWhatTheRunTells) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Scenario s = scenario(seed);
    RunOptions options;
    options.planner = seed == 3 ? PlannerKind::thesis : PlannerKind::skirt;
    const Row row = drive(s, options.planner, kOn);
    std::vector<TickRecord> records;
    options.records = &records;
    const RunResult result = run(s, options);
    EXPECT_EQ(row.planner, name(options.planner));
    EXPECT_EQ(row.seed, seed);
    EXPECT_EQ(row.verdict, result.verdict);
    EXPECT_EQ(row.detail, result.detail);
    EXPECT_EQ(row.hash, result.hash);
    EXPECT_EQ(row.ticks, result.ticks);
    EXPECT_NEAR(row.time_s, result.time_s, 6e-7);
    EXPECT_NEAR(row.path_m, result.path_m, 6e-7);
    EXPECT_NEAR(row.final_distance_m, result.final_distance_m, 6e-7);
    EXPECT_NEAR(row.min_clearance_m, result.min_clearance_m, 6e-7);
    const TickRecord& last = records.back();
    EXPECT_NEAR(row.estimate_error_m, std::hypot(last.x_m - last.est_x_m, last.y_m - last.est_y_m), 6e-7);
    EXPECT_EQ(row.estimate_error_m > 0.01, seed == 2) << "of the wheels alone";
    EXPECT_NEAR(row.believed_distance_m.value(), *result.believed_distance_m, 6e-7);
    EXPECT_EQ(row.at_goal, result.final_distance_m <= s.goal.tolerance_m);
    const auto shortest = paths::shortest_path(make_world(s), s.start.at, s.goal.at, 0.10);
    ASSERT_TRUE(row.shortest_m && shortest);
    EXPECT_NEAR(*row.shortest_m, *shortest, 6e-7);
    EXPECT_TRUE(row.looks > 0 || options.planner != PlannerKind::thesis);
    EXPECT_EQ(to_csv(row), to_csv(drive(s, options.planner, kOn)));
  }
}

TEST(Mission, IsGivenUpWhenToldToStop) {
  const std::atomic<bool> stop{true};
  EXPECT_THROW(drive(scenario(1), PlannerKind::thesis, stop), Stopped);
}

}  // namespace
}  // namespace whisker::campaign
