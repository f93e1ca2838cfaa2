#include "firmware/localization/frame.hpp"

#include <gtest/gtest.h>

#include <random>

namespace whisker::localization {
namespace {

using namespace literals;

bool operator==(const Pose& a, const Pose& b) { return a.at == b.at && a.heading == b.heading; }

/// A random position within the region, and a random heading.
class Places {
 public:
  Vec place() { return {length(), length()}; }
  Pose pose() { return {place(), Angle::from_raw(static_cast<uint32_t>(random_()))}; }

 private:
  Length length() {
    const int32_t most = kPlaceLimit.raw();
    return Length::from_raw(std::uniform_int_distribution<int32_t>(-most, most)(random_));
  }
  std::mt19937 random_{1};
};

TEST(Frame, IsTheUsersBeforeAnyTie) {
  Frame frame;
  Places places;
  for (int i = 0; i < 100; ++i) {
    const Pose p = places.pose();
    EXPECT_TRUE(frame.outward(p) == p);
    Vec goal;
    EXPECT_TRUE(frame.aim(p.at, goal));
    EXPECT_EQ(goal, p.at);
  }
}

TEST(Frame, TiesExactly) {
  Places places;
  for (int i = 0; i < 1000; ++i) {
    Frame frame;
    const Pose inside = places.pose();
    const Pose outside = places.pose();
    frame.tie(inside, outside);
    EXPECT_TRUE(frame.outward(inside) == outside);
  }
}

TEST(Frame, OnlyMovesWhereNothingTurns) {
  Frame frame;
  frame.tie({{1_m, 2_m}, 40_deg}, {{4_m, -(1_m)}, 40_deg});
  EXPECT_TRUE(frame.outward({{7_m, 7_m}, 1_deg}) == (Pose{{10_m, 4_m}, 1_deg}));
  Vec goal;
  EXPECT_TRUE(frame.aim({10_m, 4_m}, goal));
  EXPECT_EQ(goal, (Vec{7_m, 7_m}));
}

TEST(Frame, AimsAtThePlaceThatTheUserMeans) {
  Places places;
  int seen = 0;
  for (int i = 0; i < 1000; ++i) {
    Frame frame;
    const Pose turned{places.place(), places.pose().heading};
    frame.tie(places.pose(), turned);
    Vec inside;
    const Vec goal = places.place();
    if (!frame.aim(goal, inside)) continue;
    ++seen;
    EXPECT_LE(norm(frame.outward({inside, Angle{}}).at - goal), micrometres(60));
  }
  EXPECT_GT(seen, 100);
}

TEST(Frame, AGoalIsOutOfRangeOnEitherSide) {
  Frame frame;
  Vec inside;
  EXPECT_FALSE(frame.aim({kPlaceLimit + micrometres(1), Length{}}, inside));
  EXPECT_TRUE(frame.aim({kPlaceLimit, kPlaceLimit}, inside));
  frame.tie({}, {{-(100_m), Length{}}, Angle{}});
  EXPECT_FALSE(frame.aim_again(inside)) << "1,100 m from where the wheels began";
}

}  // namespace
}  // namespace whisker::localization
