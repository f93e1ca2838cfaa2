#include "host/hunt/rows.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

#include "host/hunt/corpus.hpp"
#include "host/hunt/draw.hpp"
#include "tests/hunt/folder.hpp"

namespace whisker::hunt {
namespace {

Row row(std::uint64_t seed, const std::string& finding) {
  Row r;
  r.seed = seed;
  r.family = "lag";
  r.world = "posts";
  r.driver = "guard";
  r.families = {10, 4};
  r.keys = {20, 15};
  r.end = "time";
  r.finding = finding;
  r.gap_m = 0.0123456;
  r.closeness = -0.25;
  r.hash = 0xABCDEF0123456789;
  return r;
}

TEST(Rows, ComeBackFromTheirFile) {
  const test::Folder folder;
  {
    RowFile file(folder / "rows.csv");
    file.add(row(1, ""));
    file.add(row(2, "crash what, with\ncommas"));
  }
  RowFile(folder / "rows.csv").add(row(3, "contact"));
  const std::vector<Row> rows = read_rows({folder / "rows.csv"});
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(to_csv(rows[0]), to_csv(row(1, "")));
  EXPECT_EQ(rows[1].finding, "crash what  with commas");
  EXPECT_EQ(rows[2].hash, 0xABCDEF0123456789);
}

TEST(Rows, ARowCutShortByAKillIsForgotten) {
  const test::Folder folder;
  RowFile(folder / "rows.csv").add(row(1, ""));
  std::ofstream(folder / "rows.csv", std::ios::app) << to_csv(row(2, "")).substr(0, 30);
  EXPECT_EQ(read_rows({folder / "rows.csv"}).size(), 1U);
  RowFile(folder / "rows.csv").add(row(3, ""));
  EXPECT_EQ(read_rows({folder / "rows.csv"}).back().seed, 3U);
}

TEST(Rows, TheSummaryCountsFindingsAndDraws) {
  const std::string text = summary({row(5, "contact"), row(2, "contact"), row(3, "")});
  EXPECT_NE(text.find("3 cases"), std::string::npos) << text;
  EXPECT_NE(text.find("    2  2\n"), std::string::npos) << text;
  EXPECT_NE(text.find("40.0 %"), std::string::npos) << text;
  EXPECT_NE(text.find("75.0 %"), std::string::npos) << text;
  EXPECT_NE(text.find("-0.25000  seed 3"), std::string::npos) << text;
  EXPECT_NE(summary({row(3, "")}).find("nothing found"), std::string::npos);
}

TEST(Corpus, KeepsTheNearestOfANicheAndNewStates) {
  const test::Folder folder;
  Corpus corpus(folder.path());
  const Case c = draw_case(1).c;
  Outcome outcome;
  outcome.states = {"clear"};
  outcome.closeness = 5;
  EXPECT_EQ(corpus.niche("kind", outcome), "state-clear");
  corpus.keep("state-clear", c, outcome);
  EXPECT_EQ(corpus.niche("kind", outcome), "");
  outcome.closeness = 0.1;
  EXPECT_EQ(corpus.niche("kind", outcome), "kind");
  corpus.keep("kind", c, outcome);
  EXPECT_EQ(corpus.niche("kind", outcome), "");
  outcome.closeness = 0.05;
  EXPECT_EQ(corpus.niche("kind", outcome), "kind");
  EXPECT_EQ(Corpus(folder.path()).size(), 2U);
}

}  // namespace
}  // namespace whisker::hunt
