#include "host/campaign/comparison.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace whisker::campaign {
namespace {

constexpr double kLimit = 100;

Row ended_after(Verdict verdict, double time_s) {
  Row r;
  r.verdict = verdict;
  r.time_s = time_s;
  return r;
}

Standing of(const std::vector<double>& times) {
  Standing s;
  for (const double t : times) s.add(ended_after(Verdict::reached, t), kLimit);
  return s;
}

TEST(Standing, AFailureCountsAsTenTimeLimits) {
  Standing s = of({20});
  s.add(ended_after(Verdict::gave_up, 100), kLimit);
  s.add(ended_after(Verdict::contact, 3), kLimit);
  EXPECT_EQ(s.contacts, 1U);
  EXPECT_EQ(s.successes, 1U);
  EXPECT_EQ(s.log_s, (std::vector<double>{std::log(20.0), std::log(1000.0), std::log(1000.0)}));
}

TEST(Standing, AReportOfUnreachableIsASuccessWhereNoPathExists) {
  Row r = ended_after(Verdict::unreachable, 40);
  r.world = "enclosed";
  Standing s;
  s.add(r, kLimit);
  EXPECT_EQ(s.successes, 1U);
  EXPECT_EQ(s.log_s, std::vector<double>{std::log(40.0)});
}

TEST(Standing, ContactsRankBeforeSuccessesAndSuccessesBeforeTime) {
  Standing touching = of({1, 1});
  touching.add(ended_after(Verdict::contact, 1), kLimit);
  Standing failing = of({1, 1});
  failing.add(ended_after(Verdict::gave_up, 1), kLimit);
  const Standing slow = of({90, 90, 90}), fast = of({9, 9, 9});
  EXPECT_TRUE(ranks_before(fast, slow) && !ranks_before(slow, fast) && !ranks_before(slow, slow));
  EXPECT_TRUE(ranks_before(slow, failing) && !ranks_before(failing, slow));
  EXPECT_TRUE(ranks_before(failing, touching) && !ranks_before(touching, failing));
  EXPECT_FALSE(improves(touching, slow) || improves(failing, slow));
}

TEST(Standing, OnlyWhatTheBoundsShowIsAnImprovement) {
  const Standing holder = of({10, 20, 30, 40});
  EXPECT_TRUE(improves(of({9, 17, 27, 36}), holder));
  EXPECT_FALSE(improves(of({5, 18, 30, 41}), holder));  // faster in the mean, by one world
  EXPECT_FALSE(improves(holder, holder));
  EXPECT_FALSE(improves(of({1}), of({9})));  // one world has no bounds
  EXPECT_DOUBLE_EQ(time_ratio(of({10, 20}), of({20, 10})).value, 1);
  EXPECT_DOUBLE_EQ(time_ratio(of({10, 20}), of({5, 10})).value, 0.5);
}

TEST(Halving, OneIsLeftAndDrivesAllWorlds) {
  const auto is = [](const std::vector<Round>& rounds, const std::vector<std::vector<std::size_t>>& wanted) {
    ASSERT_EQ(rounds.size(), wanted.size());
    for (std::size_t r = 0; r < rounds.size(); ++r)
      EXPECT_EQ((std::vector{rounds[r].entrants, rounds[r].worlds}), wanted[r]);
  };
  is(halving(8, 40), {{8, 5}, {4, 10}, {2, 20}, {1, 40}});
  is(halving(5, 3), {{5, 1}, {3, 1}, {2, 1}, {1, 3}});
  is(halving(1, 7), {{1, 7}});
}

}  // namespace
}  // namespace whisker::campaign
