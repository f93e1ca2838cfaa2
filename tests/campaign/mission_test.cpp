#include "host/lab/campaign/mission.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "host/harness/run/runner.hpp"
#include "host/harness/scenario/world.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/lab/campaign/failures.hpp"
#include "host/lab/campaign/row_file.hpp"
#include "host/lab/paths/shortest.hpp"

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
    options.planner = seed == 3 ? PlannerKind::thesis : PlannerKind::boundary;
    const Row row = drive(s, options.planner, kOn);
    std::vector<TickRecord> records;
    options.watch = [&](const Moment& moment) { records.push_back(moment.record); };
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

Row failed(std::uint64_t seed, const std::string& world) {
  Row row;
  row.seed = seed;
  row.world = world;
  row.verdict = Verdict::contact;
  row.detail = "stepping";
  row.planner = "thesis";
  return row;
}

TEST(Replay, NamesTheWorldAsTheCommandTakesIt) {
  EXPECT_EQ(replay_command(failed(7, "discs --discs 20 --noise")),
            "whisker campaign discs --discs 20 --noise --replay 7 --planner thesis --svg discs-7.svg");
  EXPECT_EQ(replay_command(failed(7, "some/two_discs.toml")),
            "whisker run some/two_discs.toml --seed 7 --planner thesis --svg two_discs-7.svg");
  Row row = failed(7, "some/it's.toml");
  row.robot = "my robot.toml";
  EXPECT_EQ(replay_command(row),
            "whisker run 'some/it'\\''s.toml' --seed 7 --planner thesis --robot 'my robot.toml' --svg "
            "'it'\\''s-7.svg'");
}

TEST(Failures, AreListedUpToAPointAndThenCounted) {
  std::vector<Row> rows;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    rows.push_back(failed(seed, "discs"));
    if (seed % 3 == 0) rows.back().verdict = Verdict::reached;
  }
  const std::string some = failure_lines(rows, 2);
  EXPECT_EQ(
      some,
      "seed 1 contact (stepping): whisker campaign discs --replay 1 --planner thesis --svg discs-1.svg\n"
      "seed 2 contact (stepping): whisker campaign discs --replay 2 --planner thesis --svg discs-2.svg\n"
      "and 18 more that failed\n");
  const std::string all = failure_lines(rows, 20);
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 20);
  EXPECT_EQ(all.find("more"), std::string::npos);
  rows.resize(3);
  rows.erase(rows.begin(), rows.begin() + 2);
  EXPECT_EQ(failure_lines(rows), "");
}

TEST(Failures, ThoseThatOnlyBelieveToBeThereComeAfterThem) {
  std::vector<Row> rows{failed(1, "discs"), failed(2, "discs"), failed(3, "discs"), failed(4, "discs")};
  for (const std::size_t off : {0U, 2U, 3U}) {
    rows[off].verdict = Verdict::off_goal;
    rows[off].final_distance_m = 2.856;
  }
  EXPECT_EQ(
      failure_lines(rows, 2),
      "seed 2 contact (stepping): whisker campaign discs --replay 2 --planner thesis --svg discs-2.svg\n"
      "seed 1 off_goal (2.86 m off): whisker campaign discs --replay 1 --planner thesis --svg discs-1.svg\n"
      "and 2 more that are not where they believe to be\n");
}

}  // namespace
}  // namespace whisker::campaign
