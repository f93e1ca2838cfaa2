#include "host/lab/hunt/case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "host/lab/hunt/draw.hpp"
#include "host/lab/hunt/premise.hpp"
#include "host/lab/hunt/shrink.hpp"
#include "host/lab/hunt/trial.hpp"

namespace whisker::hunt {
namespace {

TEST(Case, ItsTextsRepeatTheDrive) {
  int gaps = 0, missions = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Case c = draw_case(seed).c;
    c.scenario.time_limit_s = std::min(c.scenario.time_limit_s, 5.0);
    const Outcome outcome = attempt(c);
    Case again = parse_case(texts(c, "case"), "case");
    EXPECT_EQ(driver(again), driver(c)) << seed;
    EXPECT_EQ(again.gaps, c.gaps) << seed;
    EXPECT_EQ(again.commands.size(), c.planner ? 0 : c.commands.size()) << seed;
    const Outcome second = attempt(again);
    EXPECT_EQ(second.hash, outcome.hash) << seed;
    EXPECT_EQ(second.gap_m, outcome.gap_m) << seed;
    gaps += c.gaps != 0;
    missions += c.planner.has_value();
  }
  EXPECT_GT(gaps, 2);
  EXPECT_GT(missions, 5);
}

TEST(Case, ItsFirstLineSaysHowToRepeatIt) {
  Case c = draw_case(1).c;
  c.planner = PlannerKind::boundary;
  c.gaps = 0;
  EXPECT_EQ(texts(c, "x").toml.rfind("# whisker run x.toml --planner skirt\n", 0), 0U);
  c.gaps = 3;
  EXPECT_EQ(texts(c, "x").toml.rfind("# whisker hunt --case x.toml\n", 0), 0U);
  c.planner.reset();
  c.gaps = 0;
  c.commands = {{0, {0.1, 0}}};
  EXPECT_EQ(texts(c, "x").toml.rfind("# whisker guard x.toml --commands x.csv\n", 0), 0U);
}

/// Cases that came near, or that broke a promise once.
TEST(Cases, EndWithoutContact) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(WHISKER_SOURCE_DIR "/tests/hunt/cases")) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  EXPECT_GE(files.size(), 3U);
  for (const auto& file : files) {
    Case c = load_case(file.string());
    const Outcome outcome = attempt(c);
    EXPECT_EQ(outcome.finding, "") << file;
    EXPECT_GT(outcome.gap_m, 0) << file;
  }
}

constexpr Effort kEnough{2000, 60};

Case large() {
  Case c;
  Scenario& s = c.scenario;
  s.start.at = {3, 1};
  s.goal.at = {6, 1};
  s.sensor.corner_scatter_m = 1000;
  s.noise.range_dropout = 0.1;
  for (int i = 0; i < 30; ++i) s.discs.push_back({{5 + 0.1 * i, 2}, 0.02});
  s.walls = {{{0, 0}, {0, 5}}, {{0, 5}, {5, 5}}};
  s.bounds = Bounds{{-1, -1}, {9, 9}};
  s.robot.wheels.motor_lag = 20_ms;
  s.robot.wheels.max_turn_rate = 2500_mrad_per_s;
  c.gaps = 17;
  for (int i = 0; i < 100; ++i) c.commands.push_back({i * 0.1, {0.2, 0.01 * i}});
  return c;
}

TEST(Shrunk, KeepsOnlyWhatTheFailureNeeds) {
  const auto fails = [](const Case& c) {
    const auto& discs = c.scenario.discs;
    const bool post = std::any_of(discs.begin(), discs.end(), [&](const sim::Disc& d) {
      return std::abs(d.center.x - c.scenario.start.at.x - 2.7) < 0.01;
    });
    const bool turn = std::any_of(c.commands.begin(), c.commands.end(), [](const guard::Command& command) {
      return command.twist.turning_radps > 0.7;
    });
    return post && turn && c.scenario.robot.wheels.motor_lag == 20_ms;
  };
  const Case c = shrunk(large(), fails, kEnough);
  EXPECT_TRUE(fails(c));
  EXPECT_EQ(c.scenario.discs.size(), 1U);
  EXPECT_TRUE(c.scenario.walls.empty());
  EXPECT_FALSE(c.scenario.bounds);
  EXPECT_EQ(c.commands.size(), 1U);
  EXPECT_EQ(c.gaps, 0U);
  EXPECT_EQ(c.scenario.noise.range_dropout, 0);
  EXPECT_EQ(c.scenario.start.at.x, 0);
  EXPECT_EQ(c.scenario.robot.wheels.max_turn_rate, Params{}.wheels.max_turn_rate);
  EXPECT_EQ(c.scenario.robot.wheels.motor_lag, 20_ms);
}

TEST(Shrunk, LeavesNothingOutsideThePremise) {
  Case c = large();
  // Without its own gap, this period breaks a relation.
  c.scenario.robot.safety.period = 50_ms;
  c.scenario.robot.safety.max_gap = 100_ms;
  const auto fails = [](const Case& other) { return other.scenario.robot.safety.period == 50_ms; };
  EXPECT_TRUE(holds_premise(shrunk(c, fails, kEnough).scenario));
}

TEST(Shrunk, EndsWithItsEffort) {
  int drives = 0;
  const auto fails = [&](const Case&) { return ++drives > 0; };
  shrunk(large(), fails, {10, 60});
  EXPECT_EQ(drives, 10);
}

TEST(FindingOf, RecordsTheAttacker) {
  Case c = large();
  c.commands.clear();
  c.scenario.time_limit_s = 2;
  EXPECT_EQ(finding_of(c), "");
  EXPECT_GT(c.commands.size(), 5U);
}

}  // namespace
}  // namespace whisker::hunt
