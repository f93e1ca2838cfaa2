#include "host/campaign/failures.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace whisker::campaign {
namespace {

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
