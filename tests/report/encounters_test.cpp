#include "host/lab/report/encounters.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/report/script.hpp"

namespace whisker::report {
namespace {

using planning::Mode;
using planning::Why;

struct Doings {
  Mode mode;
  Why why = Why::none;
  int danger = 0;
};

std::vector<TickRecord> drive(const std::vector<Doings>& script) {
  std::vector<TickRecord> records;
  for (const Doings& d : script) {
    TickRecord r;
    r.mode = d.mode;
    r.why = d.why;
    r.danger_count = static_cast<std::uint8_t>(d.danger);
    r.x_m = static_cast<double>(records.size());
    records.push_back(r);
  }
  return records;
}

constexpr Doings kGoing{Mode::going, Why::target_free};
constexpr Doings kHit{Mode::searching, Why::target_blocked};
constexpr Doings kEdge{Mode::following, Why::edge};

TEST(Encounters, LastFromTheHitToTheLeave) {
  const auto records = drive({{Mode::surveying, Why::goal_set},
                              kGoing,
                              kHit,
                              kEdge,
                              {Mode::looking, Why::unknown_ahead},
                              kEdge,
                              kGoing,
                              {Mode::going, Why::narrow},
                              kHit,
                              kEdge,
                              {Mode::arrived, Why::at_goal}});
  const auto all = encounters(records);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].hit, &records[2]);
  EXPECT_EQ(all[0].left, &records[6]);
  EXPECT_EQ(all[0].turned, nullptr);
  EXPECT_EQ(all[1].hit, &records[8]);
  EXPECT_EQ(all[1].left, &records[10]);
  for (const Encounter& e : all) EXPECT_EQ(e.end, Encounter::End::left);
}

TEST(Encounters, OfTheThesisPlannerLastWhileItsDangerCounterRuns) {
  const auto records = drive({{Mode::facing, Why::target_free},
                              {Mode::looking, Why::target_blocked, 1},
                              {Mode::following, Why::exit_left, 1},
                              {Mode::facing, Why::exit_left, 1},
                              {Mode::looking, Why::same_side, 2},
                              {Mode::looking, Why::target_free, 0},
                              {Mode::stepping, Why::target_free, 0}});
  const auto all = encounters(records);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].hit, &records[1]);
  EXPECT_EQ(all[0].left, &records[6]);
}

TEST(Encounters, MayEndWithTheWallLostOrTheVerdictOrTheRun) {
  const auto lost = drive({kGoing, kHit, kEdge, {Mode::going, Why::wall_lost}});
  ASSERT_EQ(encounters(lost).size(), 1U);
  EXPECT_EQ(encounters(lost)[0].end, Encounter::End::wall_lost);
  EXPECT_EQ(encounters(lost)[0].left, &lost[3]);

  const auto shut = drive({kHit,
                           kEdge,
                           {Mode::following, Why::came_round},
                           {Mode::searching, Why::came_round},
                           kEdge,
                           {Mode::unreachable, Why::came_round}});
  ASSERT_EQ(encounters(shut).size(), 1U);
  EXPECT_EQ(encounters(shut)[0].end, Encounter::End::unreachable);
  EXPECT_EQ(encounters(shut)[0].turned, &shut[2]);
  EXPECT_EQ(encounters(shut)[0].left, &shut[5]);

  for (const Mode mode : {Mode::gave_up, Mode::stopped, Mode::following}) {
    const auto open = drive({kHit, kEdge, {mode, Why::no_exit}});
    ASSERT_EQ(encounters(open).size(), 1U);
    EXPECT_EQ(encounters(open)[0].end, Encounter::End::none);
    EXPECT_EQ(encounters(open)[0].left, nullptr);
  }
}

TEST(Encounters, BeginAtAPlaceThatCanBeDrawn) {
  auto records = drive({kGoing, kHit, kEdge, kGoing, kGoing});
  records[1].x_m = std::numeric_limits<double>::quiet_NaN();
  records[3].y_m = 1e12;
  ASSERT_EQ(encounters(records).size(), 1U);
  EXPECT_EQ(encounters(records)[0].hit, &records[2]);
  EXPECT_EQ(encounters(records)[0].left, &records[4]);
}

TEST(Encounters, AreNoneWhereNothingWasInTheWay) {
  EXPECT_TRUE(encounters({}).empty());
  EXPECT_TRUE(encounters(drive({kGoing, {Mode::looking, Why::unknown_ahead}, kGoing})).empty());
  EXPECT_EQ(encounters(testing::garden_run(testing::garden())).size(), 1U);
}

std::vector<TickRecord> said(const std::vector<Guidance>& all) {
  std::vector<TickRecord> records(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) records[i].guide = all[i];
  return records;
}

constexpr Guidance kNone = Guidance::none, kGoal = Guidance::goal, kPlace = Guidance::place,
                   kWait = Guidance::wait;

TEST(HandOvers, are_none_without_a_map_and_before_it_leads) {
  EXPECT_TRUE(hand_overs({}).empty());
  EXPECT_TRUE(hand_overs(said({Guidance::unknown, Guidance::unknown})).empty());
  EXPECT_TRUE(hand_overs(said({kNone, kNone, kPlace, kWait, kGoal})).empty());
}

TEST(HandOvers, go_to_the_edges_and_back) {
  const auto records = said({kNone, kPlace, kWait, kNone, kNone, kGoal, kPlace, kNone});
  const auto all = hand_overs(records);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].at, &records[3]);
  EXPECT_TRUE(all[0].to_edges);
  EXPECT_EQ(all[1].at, &records[5]);
  EXPECT_FALSE(all[1].to_edges);
  EXPECT_EQ(all[2].at, &records[7]);
  EXPECT_TRUE(all[2].to_edges);
}

}  // namespace
}  // namespace whisker::report
