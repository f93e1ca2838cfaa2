#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "host/scenario/world.hpp"

namespace whisker {
namespace {

constexpr int kCount = 10000;

Scenario discs(double soft, std::uint64_t seed) {
  Scenario s;
  s.seed = seed;
  s.sensor.soft = soft;
  s.discs.assign(kCount, {{5, 5}, 0.1});
  return s;
}
int count(const World& world) { return std::accumulate(world.soft.begin(), world.soft.end(), 0); }

TEST(SoftObstacles, AreTheStatedShare) {
  for (const double share : {0.1, 0.5, 0.9}) {
    const World world = make_world(discs(share, 4711));
    ASSERT_EQ(world.soft.size(), std::size_t{kCount});
    EXPECT_NEAR(count(world), share * kCount, 4 * std::sqrt(share * (1 - share) * kCount)) << "seed 4711";
  }
  EXPECT_TRUE(make_world(discs(0, 1)).soft.empty());
  EXPECT_EQ(count(make_world(discs(1, 1))), kCount);
}

TEST(SoftObstacles, DependOnTheSeedAndAreTheSameEachTime) {
  EXPECT_EQ(make_world(discs(0.5, 7)).soft, make_world(discs(0.5, 7)).soft);
  EXPECT_NE(make_world(discs(0.5, 7)).soft, make_world(discs(0.5, 8)).soft);
}

TEST(SoftObstacles, AreSoftAsAWhole) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Scenario s;
    s.seed = seed;
    s.sensor.soft = 0.5;
    s.polygons = {{{1, 1}, {2, 1}, {1, 2}}, {{3, 3}, {4, 3}, {4, 4}, {3, 4}}};
    s.walls = {{{5, 5}, {6, 5}, {7, 6}}};
    s.bounds = Bounds{{-9, -9}, {9, 9}};
    const World world = make_world(s);
    ASSERT_EQ(world.soft.size(), world.segments.size());
    constexpr std::size_t kFrom[] = {0, 3, 7, 9, 13};
    for (int k = 0; k < 4; ++k) {
      for (std::size_t i = kFrom[k]; i < kFrom[k + 1]; ++i) {
        ASSERT_EQ(world.soft.at(i), world.soft.at(kFrom[k])) << seed;
      }
    }
  }
}

TEST(SoftObstacles, OfOneKindDoNotChangeThoseOfAnother) {
  Scenario s = discs(0.5, 3);
  s.discs.resize(40);
  s.movers.assign(30, {{7, 7}, 0.1, {{7, 7}, {8, 7}}, 0});
  const World more = make_world(s);
  s.discs.resize(20);
  const World fewer = make_world(s);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(more.soft[i], fewer.soft[i]);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_EQ(more.soft[40 + i], fewer.soft[20 + i]);
}

}  // namespace
}  // namespace whisker
