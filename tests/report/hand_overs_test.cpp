#include "host/report/encounters.hpp"

#include <gtest/gtest.h>

namespace whisker::report {
namespace {

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
