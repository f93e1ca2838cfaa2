#include "host/campaign/summary.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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

}  // namespace
}  // namespace whisker::campaign
