#include "host/lab/hunt/hunt.hpp"

#include <gtest/gtest.h>

#include <signal.h>
#include <stdlib.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

#include "host/lab/hunt/corpus.hpp"
#include "host/lab/hunt/crew.hpp"
#include "host/lab/hunt/draw.hpp"
#include "host/lab/hunt/rows.hpp"
#include "tests/effort.hpp"
#include "tests/hunt/folder.hpp"

namespace whisker::hunt {
namespace {

std::set<std::string> rows_of(Options options) {
  std::set<std::string> rows;
  options.show = [&](const Progress&, const Row* row) {
    if (row != nullptr) rows.insert(to_csv(*row));
  };
  hunt(options);
  return rows;
}

Options few() {
  Options options;
  options.seed = 900;
  options.count = 12;
  return options;
}

TEST(Hunt, FreshRowsDependOnTheirSeedsOnly) {
  Options options = few();
  const std::set<std::string> all = rows_of(options);
  EXPECT_EQ(all.size(), 12U);
  options.jobs = 3;
  EXPECT_EQ(rows_of(options), all);
  std::set<std::string> shards;
  options.shards = 2;
  for (options.shard = 0; options.shard < 2; ++options.shard) {
    const std::set<std::string> part = rows_of(options);
    EXPECT_EQ(part.size(), 6U);
    shards.insert(part.begin(), part.end());
  }
  EXPECT_EQ(shards, all);
}

TEST(Hunt, GoesOnWhereItWasEnded) {
  const test::Folder folder;
  Options options = few();
  options.out = folder.path();
  int rows = 0;
  options.show = [&](const Progress&, const Row* row) { rows += row != nullptr; };
  options.stop = [&] { return rows >= 5; };
  hunt(options);
  EXPECT_EQ(rows, 5);
  options.stop = nullptr;
  hunt(options);
  EXPECT_EQ(rows, 12);
  std::set<std::uint64_t> seeds;
  for (const Row& row : read_rows({folder / "rows.csv"})) seeds.insert(row.seed);
  EXPECT_EQ(seeds.size(), 12U);
}

TEST(Hunt, ChangesWhatCameNear) {
  const test::Folder folder;
  Options options;
  options.seed = 900;
  options.time_s = 1e6;
  options.out = folder.path();
  int fresh = 0, changed = 0;
  options.show = [&](const Progress&, const Row* row) {
    if (row != nullptr) ++(row->parent.empty() ? fresh : changed);
  };
  options.stop = [&] { return fresh >= 3 && changed >= 3; };
  hunt(options);
  EXPECT_GE(changed, 3);
}

TEST(Crew, BringsWhatAJobSaid) {
  const std::string much(1 << 20, 'x');
  const Ended ended = isolated([&](const Say& say) {
    say("a\n");
    say(much);
  });
  EXPECT_EQ(ended.text, "a\n" + much);
  EXPECT_EQ(ended.death, "");
}

TEST(Crew, ADeathIsAResult) {
  const Ended killed = isolated([](const Say& say) {
    say("before");
    ::raise(SIGFPE);
  });
  EXPECT_EQ(killed.text, "before");
  EXPECT_EQ(killed.death, "signal 8");
  const Ended threw = isolated([](const Say& say) {
    say("before");
    throw std::runtime_error("why");
  });
  EXPECT_EQ(threw.text, "before");
  EXPECT_EQ(threw.death, "why");
}

TEST(Crew, RunsSeveralAtOnce) {
  Crew crew;
  for (std::uint64_t id = 1; id <= 5; ++id) {
    crew.start(id, [id](const Say& say) { say(std::to_string(id)); });
  }
  std::set<std::string> all;
  while (crew.busy() > 0) {
    for (const Ended& ended : crew.wait()) {
      EXPECT_EQ(ended.text, std::to_string(ended.id));
      all.insert(ended.text);
    }
  }
  EXPECT_EQ(all.size(), 5U);
}

// A short hunt over the same seeds each time. What it finds, `whisker hunt --again SEED` repeats.

constexpr std::uint64_t kFirst = 5000;
constexpr std::uint64_t kSeeds = 1000;  // a quarter of them drives

/// Faults and missions that give up are for longer hunts.
TEST(Seeds, NothingTouchesCrashesOrDiffers) {
  Options options;
  options.seed = kFirst;
  options.count = test::effort(kSeeds);
  std::uint64_t cases = 0;
  options.show = [&](const Progress&, const Row* row) {
    if (row == nullptr) return;
    ++cases;
    EXPECT_FALSE(harms(row->finding)) << "whisker hunt --again " << row->seed << ": " << row->finding;
  };
  hunt(options);
  EXPECT_EQ(cases, options.count);
}

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
  corpus.keep("kind", c, outcome);
  // The dearest tick of a kind has a niche of its own, and so has what becomes of it.
  outcome.work = Work::kMost * 8 / 10;
  EXPECT_EQ(corpus.niche("kind", outcome), "kind-dear");
  corpus.keep("kind-dear", c, outcome);
  EXPECT_EQ(corpus.niche("kind", outcome), "");
  outcome.closeness = 5;
  ++outcome.work;
  EXPECT_EQ(corpus.niche("kind", outcome), "kind-dear");
  EXPECT_EQ(corpus.niche("kind-dear", outcome), "kind-dear");
  EXPECT_EQ(Corpus(folder.path()).size(), 3U);
}

}  // namespace
}  // namespace whisker::hunt
