#include "host/hunt/case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "host/hunt/draw.hpp"
#include "host/hunt/trial.hpp"

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
  c.planner = PlannerKind::skirt;
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

}  // namespace
}  // namespace whisker::hunt
