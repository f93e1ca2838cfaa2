#include "host/worlds/random.hpp"

#include <gtest/gtest.h>

namespace whisker::worlds {
namespace {

TEST(Random, IsSplitMix64) {
  // The first numbers of the reference program by the algorithm's authors, for this seed.
  Random random(1234567);
  for (const std::uint64_t expected :
       {6457827717110365317U, 3203168211198807973U, 9817491932198370423U, 4593380528125082431U}) {
    EXPECT_EQ(random.bits(), expected);
  }
}

TEST(Random, FillsItsIntervalEvenlyAndStaysInside) {
  Random random(5);
  int tenths[10] = {};
  for (int i = 0; i < 100000; ++i) {
    const double x = random.uniform(-2, 3);
    ASSERT_GE(x, -2);
    ASSERT_LT(x, 3);
    ++tenths[static_cast<int>((x + 2) * 2)];
  }
  // Four standard deviations of a binomial count of 10000 are 380.
  for (const int count : tenths) EXPECT_NEAR(count, 10000, 380);
}

TEST(Random, PicksEveryIndexAndNoOther) {
  Random random(6);
  int counts[7] = {};
  for (int i = 0; i < 7000; ++i) {
    const int k = random.index(7);
    ASSERT_GE(k, 0);
    ASSERT_LT(k, 7);
    ++counts[k];
  }
  for (const int count : counts) EXPECT_NEAR(count, 1000, 120);
}

TEST(Random, TakesItsChances) {
  Random random(7);
  int hits = 0;
  for (int i = 0; i < 10000; ++i) hits += random.chance(0.3) ? 1 : 0;
  EXPECT_NEAR(hits, 3000, 184);
}

}  // namespace
}  // namespace whisker::worlds
