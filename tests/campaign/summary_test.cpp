#include "host/lab/campaign/summary.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "host/harness/scenario/error.hpp"
#include "host/harness/worlds/random.hpp"
#include "host/lab/campaign/ordered.hpp"
#include "host/lab/campaign/row_file.hpp"
#include "tests/campaign/rows.hpp"

namespace whisker::campaign {
namespace {

Row row(std::uint64_t seed, Verdict verdict, double time_s, double path_m) {
  Row r;
  r.seed = seed;
  r.verdict = verdict;
  r.time_s = time_s;
  r.path_m = path_m;
  r.shortest_m = 2;
  r.world = "discs";
  r.planner = "thesis";
  return r;
}

TEST(Summary, SharesAreOfAllMissionsAndTimesOfThoseThatArrived) {
  std::vector<Row> rows{row(3, Verdict::reached, 10, 2), row(1, Verdict::reached, 30, 3),
                        row(2, Verdict::gave_up, 1800, 90), row(5, Verdict::contact, 1, 0)};
  rows[0].stops = 4;
  rows[2].stops = 15;
  const Summary s = summarize(rows);
  EXPECT_EQ(s.missions, 4U);
  EXPECT_EQ(s.least_seed, 1U);
  EXPECT_EQ(s.greatest_seed, 5U);
  EXPECT_EQ(s.worlds, std::vector<std::string>{"discs"});
  EXPECT_EQ(s.success.value, 0.5);
  EXPECT_EQ(s.gave_up.value, 0.25);
  EXPECT_EQ(s.contact.value, 0.25);
  EXPECT_EQ(s.unreachable.value, 0);
  EXPECT_EQ(s.ratio_mean->value, 1.25);
  EXPECT_EQ(s.s_per_m_p50->value, 5);
  EXPECT_EQ(s.s_per_m_p95->value, 15);
  EXPECT_EQ(s.path_p50.value, 2) << "of all four";
  EXPECT_EQ(s.path_p95.value, 90);
  EXPECT_EQ(s.stops.rate->value, 0.2) << "19 stops on 95 m";
  EXPECT_EQ(s.stops.p50->value, 15.0 / 90) << "of the three that drove";
}

TEST(Summary, WhatIsUnreachableRightlyOrNotIsToldApart) {
  std::vector<Row> rows{row(1, Verdict::unreachable, 10, 2), row(2, Verdict::unreachable, 10, 2)};
  rows[1].world = "enclosed --box";
  const Summary s = summarize(rows);
  EXPECT_EQ(s.no_way, 1U);
  EXPECT_EQ(s.success.value, 0.5);
  EXPECT_EQ(s.unreachable.value, 1);
  EXPECT_EQ(s.false_unreachable.value, 0.5);
  EXPECT_FALSE(s.ratio_mean);
  EXPECT_FALSE(s.s_per_m_p50);
}

TEST(Summary, BelievingToBeThereIsNotBeingThere) {
  std::vector<Row> rows{row(1, Verdict::off_goal, 10, 2), row(2, Verdict::reached, 10, 2),
                        row(3, Verdict::gave_up, 10, 2), row(4, Verdict::contact, 10, 2)};
  rows[1].at_goal = rows[2].at_goal = true;
  rows[0].final_distance_m = 2.9;
  rows[1].final_distance_m = 0.05;
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].estimate_error_m = 0.1 * static_cast<double>(4 - i);
  const Summary s = summarize(rows);
  EXPECT_EQ(s.success.value, 0.5);
  EXPECT_EQ(s.reached.value, 0.5);
  EXPECT_EQ(s.truly_there.value, 0.25);
  EXPECT_EQ(s.off_goal.value, 0.25);
  EXPECT_EQ(s.final_distance_p50->value, 0.05) << "of the two that say reached";
  EXPECT_EQ(s.final_distance_p95->value, 2.9);
  EXPECT_EQ(s.ratio_mean->value, 1) << "of both";
  EXPECT_EQ(s.estimate_error_p50.value, 0.2) << "of all four";
  EXPECT_EQ(s.estimate_error_p95.value, 0.4);
}

TEST(Summary, LeadsWithWhatIsTrue) {
  const Summary s = summarize({row(1, Verdict::off_goal, 10, 2), row(2, Verdict::reached, 10, 2)});
  const std::string words = summary_words(s);
  EXPECT_EQ(words.find("truly there"), words.find('\n') + 1) << words;
  const auto json = nlohmann::json::parse(summary_json(s));
  EXPECT_EQ(json["truly_there"], json["at_goal"]);
  EXPECT_EQ(json["truly_there"]["value"], 0.5);
  EXPECT_EQ(json["off_goal"]["value"], 0.5);
  EXPECT_EQ(json["reached"]["value"], 1.0);
  EXPECT_EQ(json["success"]["value"], 1.0);
}

TEST(Summary, AMissionWithoutAKnownWayHasNoRatio) {
  std::vector<Row> rows{row(1, Verdict::reached, 10, 2), row(2, Verdict::reached, 10, 4)};
  rows[1].shortest_m.reset();
  EXPECT_EQ(summarize(rows).ratio_mean->value, 1);
  EXPECT_FALSE(summarize(rows).ratio_mean->low) << "one mission bounds nothing";
}

TEST(Summary, WordsAndJsonNameWhatIsNotThere) {
  const Summary s = summarize({row(1, Verdict::gave_up, 10, 0)});
  EXPECT_NE(summary_words(s).find("\nratio      mean           -\n"), std::string::npos) << summary_words(s);
  EXPECT_NE(summary_json(s).find(R"("ratio":{"mean":null,"p50":null,"p95":null})"), std::string::npos);
  EXPECT_NE(summary_json(s).find(R"("success":{"value":0.0,"low":0.0,"high":0.793451})"), std::string::npos)
      << summary_json(s);
}

std::string line(std::uint64_t seed, const std::string& world = "discs",
                 const std::string& planner = "thesis") {
  Row row;
  row.seed = seed;
  row.world = world;
  row.planner = planner;
  return to_csv(row) + "\n";
}

const std::string kHead = std::string(kRowHeader) + "\n";

class Merge : public ::testing::Test {
 protected:
  std::string complaint(const std::vector<std::string>& files) {
    try {
      merged(files);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  Folder folder_;
};

TEST_F(Merge, PutsTheMissionsInOrderWhereverTheyStand) {
  const std::string a = folder_.file("a.csv", kHead + line(10) + line(3) + kHead + line(2, "maze"));
  const std::string b = folder_.file("b.csv", kHead + line(9) + line(3, "discs", "other"));
  std::string order;
  for (const Row& row : merged({a, b}))
    order += row.world + " " + row.planner + " " + std::to_string(row.seed) + "; ";
  EXPECT_EQ(order, "discs other 3; discs thesis 3; discs thesis 9; discs thesis 10; maze thesis 2; ");
}

TEST_F(Merge, AMissionThatIsThereTwiceIsRefusedWithBothPlaces) {
  const std::string a = folder_.file("a.csv", kHead + line(1) + line(2));
  const std::string b = folder_.file("b.csv", kHead + line(3) + line(2));
  EXPECT_EQ(complaint({a, b}), b + ":3:1: seed 2 is there already, in " + a + ":3");
  EXPECT_EQ(complaint({a, a}), a + ":2:1: seed 1 is there already, in " + a + ":2");
}

TEST_F(Merge, AWrongFileIsRefusedWithItsLine) {
  const std::string good = folder_.file("good.csv", kHead + line(1));
  const auto refused = [&](const std::string& text) {
    const std::string file = folder_.file("bad.csv", text);
    const std::string words = complaint({good, file});
    return words.rfind(file, 0) == 0 ? words.substr(file.size()) : "not about the file: " + words;
  };
  EXPECT_EQ(refused(""), ":1:1: empty: not even the header of a campaign");
  EXPECT_EQ(refused(line(2)).substr(0, 40), ":1:1: not the header of a campaign: seed");
  EXPECT_EQ(refused(kHead + line(2) + "x" + line(3)), ":3:1: column seed: 'x3' is no such number");
  EXPECT_EQ(refused(kHead + line(2) + "\n"), ":3:1: no column outcome");
  EXPECT_EQ(refused(kHead + line(2) + "4,gave"), ":3:1: the last line is cut off: it has no end of line");
  EXPECT_EQ(complaint({folder_.path("none.csv")}),
            folder_.path("none.csv") + ":1:1: No such file or directory");
  EXPECT_EQ(complaint({folder_.path("")}), folder_.path("") + ":1:1: cannot read the file");
}

// Written by an older `whisker campaign`, which reported a wrong belief as `reached`.
TEST_F(Merge, RowsFromBeforeOffGoalAreJudgedByTheirTruePlace) {
  const std::string old = std::string(WHISKER_SOURCE_DIR) + "/tests/campaign/old_rows.csv";
  int reached = 0, off = 0, other = 0;
  for (const Row& row : merged({old})) {
    EXPECT_FALSE(row.believed_distance_m);
    EXPECT_EQ(row.verdict == Verdict::off_goal, row.final_distance_m > 0.1 && row.detail == "at_goal");
    ++(row.verdict == Verdict::reached ? reached : row.verdict == Verdict::off_goal ? off : other);
  }
  EXPECT_EQ(reached, 2);
  EXPECT_EQ(off, 5);
  EXPECT_EQ(other, 1);
  const std::string both = folder_.file("both.csv", text_of(old) + kHead + line(99999, "maze"));
  EXPECT_EQ(merged({both}).size(), 9U);
  const std::string mixed = folder_.file("mixed.csv", text_of(old) + line(99999, "maze"));
  EXPECT_EQ(complaint({mixed}), mixed + ":10:1: the row is not one that campaign writes");
}

TEST_F(Merge, HeadersAloneHaveNothingToSumUp) {
  const std::string empty = folder_.file("empty.csv", kHead);
  EXPECT_EQ(complaint({empty, empty}), empty + ":1:1: no mission in it");
  EXPECT_EQ(merged({empty, folder_.file("one.csv", kHead + line(1))}).size(), 1U);
}

/// Work whose pieces take unequal time; each returns its own number as the seed.
Work uneven(std::uint64_t count, int jobs, std::vector<std::uint64_t>& taken) {
  Work work;
  work.count = count;
  work.jobs = jobs;
  work.make = [](std::uint64_t piece, const std::atomic<bool>&) {
    std::this_thread::sleep_for(std::chrono::microseconds(worlds::Random(piece).index(400)));
    Row row;
    row.seed = piece;
    return row;
  };
  work.take = [&taken](const Row& row) { taken.push_back(row.seed); };
  work.wait = [](std::uint64_t) {};
  work.stop = [] { return false; };
  return work;
}

void expect_first(const std::vector<std::uint64_t>& taken) {
  for (std::size_t i = 0; i < taken.size(); ++i) ASSERT_EQ(taken[i], i);
}

TEST(Ordered, ResultsComeInOrderWhateverTheNumberOfThreads) {
  for (const int jobs : {1, 2, 3, 16, 200}) {
    std::vector<std::uint64_t> taken;
    EXPECT_EQ(do_in_order(uneven(150, jobs, taken)), 150U);
    EXPECT_EQ(taken.size(), 150U);
    expect_first(taken);
  }
}

TEST(Ordered, NothingToDoIsDone) {
  std::vector<std::uint64_t> taken;
  EXPECT_EQ(do_in_order(uneven(0, 4, taken)), 0U);
}

TEST(Ordered, AStopLeavesTheFirstResultsOnly) {
  for (const int jobs : {1, 4}) {
    std::vector<std::uint64_t> taken;
    Work work = uneven(100000, jobs, taken);
    work.stop = [&] { return taken.size() >= 20; };
    const std::uint64_t done = do_in_order(work);
    EXPECT_EQ(done, taken.size());
    EXPECT_GE(done, 20U);
    EXPECT_LT(done, 100000U);
    expect_first(taken);
  }
}

TEST(Ordered, PiecesUnderWayAreToldToStop) {
  std::vector<std::uint64_t> taken;
  Work work = uneven(100, 3, taken);
  const auto quick = work.make;
  work.make = [&](std::uint64_t piece, const std::atomic<bool>& stop) {
    while (piece >= 5 && !stop) std::this_thread::yield();
    if (piece >= 5) throw Stopped{};
    return quick(piece, stop);
  };
  work.stop = [&] { return taken.size() == 5; };
  EXPECT_EQ(do_in_order(work), 5U);
  expect_first(taken);
}

TEST(Ordered, AnErrorComesAfterTheResultsBeforeIt) {
  for (const int jobs : {1, 2, 8}) {
    std::vector<std::uint64_t> taken;
    Work work = uneven(1000, jobs, taken);
    const auto good = work.make;
    work.make = [&](std::uint64_t piece, const std::atomic<bool>& stop) {
      if (piece == 37) throw std::runtime_error("37");
      return good(piece, stop);
    };
    EXPECT_THROW(do_in_order(work), std::runtime_error);
    EXPECT_EQ(taken.size(), 37U);
    expect_first(taken);
  }
}

TEST(Ordered, AnErrorOfTheTakerEndsTheWork) {
  std::vector<std::uint64_t> taken;
  Work work = uneven(1000, 4, taken);
  work.take = [](const Row&) { throw std::runtime_error("full"); };
  EXPECT_THROW(do_in_order(work), std::runtime_error);
}

}  // namespace
}  // namespace whisker::campaign
