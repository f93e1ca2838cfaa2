#include "host/campaign/motion_count.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace whisker::campaign {
namespace {

constexpr double kTrack = 0.14;

struct Tick {
  double speed = 0, turn_rate = 0;
  bool looked = false;
};

MotionCount counted(const std::vector<Tick>& ticks) {
  MotionCount count(kTrack);
  for (const Tick& tick : ticks) {
    TickRecord r;
    r.v_left_mps = tick.speed - tick.turn_rate * kTrack / 2;
    r.v_right_mps = tick.speed + tick.turn_rate * kTrack / 2;
    r.looked = tick.looked;
    count.add(r);
  }
  return count;
}

std::uint64_t stops(const std::vector<double>& speeds) {
  std::vector<Tick> ticks;
  for (const double speed : speeds) ticks.push_back({speed});
  return counted(ticks).stops();
}

std::uint64_t flips(const std::vector<double>& rates) {
  std::vector<Tick> ticks;
  for (const double rate : rates) ticks.push_back({0.2, rate});
  return counted(ticks).flips();
}

TEST(MotionCount, AStopCountsWhenTheRobotDrivesOn) {
  EXPECT_EQ(stops({}), 0U);
  EXPECT_EQ(stops({0, 0, 0.06, 0.3}), 0U) << "setting out";
  EXPECT_EQ(stops({0, 0.3, 0, 0}), 0U) << "the last one";
  EXPECT_EQ(stops({0.3, 0, 0, 0.3, 0.009, 0.3, 0}), 2U);
  EXPECT_EQ(stops({0.3, -0.2, 0.3}), 1U) << "backing up";
  EXPECT_EQ(stops({0.3, 0.011, 0.3}), 0U) << "only slow";
  EXPECT_EQ(stops({0.3, 0, 0.049, 0, 0.049, 0.3}), 1U) << "creeping is no driving";
}

TEST(MotionCount, AFlipIsATurnToTheOtherSide) {
  EXPECT_EQ(flips({0.5, 1, 0.3, 0.5}), 0U);
  EXPECT_EQ(flips({0.5, -0.5, 0.5}), 2U);
  EXPECT_EQ(flips({0.5, 0, 0, -0.5}), 1U);
  EXPECT_EQ(flips({0.5, -0.19, 0.5}), 0U) << "too slow for a turn";
  EXPECT_EQ(flips({0.5, -0.21, 0.5}), 2U);
}

TEST(MotionCount, ALookIsASpellOfLooking) {
  const auto looks = [](const std::vector<int>& looked) {
    std::vector<Tick> ticks;
    for (const int l : looked) ticks.push_back({0, 0, l != 0});
    return counted(ticks).looks();
  };
  EXPECT_EQ(looks({0, 0}), 0U);
  EXPECT_EQ(looks({1, 0, 1, 0, 0, 1}), 3U);
  EXPECT_EQ(looks({0, 1, 1, 1, 0}), 1U);
}

TEST(MotionCount, TurningSumsUpBothWays) {
  MotionCount count(kTrack);
  for (const double heading : {7.0, 7.5, 7.25, 6.25}) {
    TickRecord r;
    r.heading_rad = heading;
    count.add(r);
  }
  EXPECT_DOUBLE_EQ(count.turned_rad(), 1.75);
}

}  // namespace
}  // namespace whisker::campaign
