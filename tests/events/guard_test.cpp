// What events do to a drive behind the guard.
#include <gtest/gtest.h>

#include <cmath>

#include "host/lab/guard/drive.hpp"
#include "tests/events/scene.hpp"

namespace whisker::guard {
namespace {

using test::event;
using test::scene;

/// Straight ahead at 0.2 m/s.
class Ahead final : public Operator {
 public:
  Twist ask(const Sight&) override { return {0.2, 0}; }
};

struct Seen {
  Result result;
  std::vector<double> speeds;  // by tick
};

Seen ahead(const std::string& events, bool until_goal = false) {
  Seen seen;
  Ahead hand;
  Options options;
  options.time_s = 8;
  options.vouched_m = 0.3;
  options.until_goal = until_goal;
  options.watch = [&](const Moment& m) { seen.speeds.push_back((m.v_left_mps + m.v_right_mps) / 2); };
  const Scenario s = scene(events);
  seen.result = drive(s, hand, options);
  return seen;
}

TEST(GuardEvents, NoneChangesNothing) {
  const Seen plain = ahead(""), late = ahead(event(9, "restart"));
  EXPECT_EQ(late.result.hash, plain.result.hash);
  EXPECT_FALSE(plain.result.events);
}

TEST(GuardEvents, AGoalEndsTheDriveThere) {
  const Seen seen = ahead(event(2, "goal", "x_m = 1\ny_m = 0\n"), true);
  EXPECT_EQ(seen.result.end, End::arrived);
  EXPECT_LE(seen.result.final_distance_m, 0.1);
  EXPECT_LT(seen.result.time_s, 7);
}

TEST(GuardEvents, AResetForgetsTheGroundAndItDrivesOn) {
  const Seen seen = ahead(event(4, "reset"));
  EXPECT_EQ(seen.result.events->played, 1U);
  EXPECT_NE(seen.result.hash, ahead("").result.hash);
  EXPECT_NE(seen.result.end, End::contact);
}

TEST(GuardEvents, LostFramesStopIt) {
  const Seen seen = ahead(event(3, "frames_lost", "for_s = 2\n"));
  EXPECT_GT(seen.speeds[303], 0.15);
  for (std::size_t i = 370; i < 500; ++i) EXPECT_NEAR(seen.speeds[i], 0, 1e-3) << i;
  EXPECT_EQ(seen.result.end, End::time);
  EXPECT_GT(seen.speeds.back(), 0.1) << "it drives on";
}

TEST(GuardEvents, AParameterCountsFromTheNextRestartOn) {
  const std::string slow = event(2, "param", "name = \"wheel_speed_max_mps\"\nvalue = 0.1\n");
  EXPECT_EQ(ahead(slow).result.hash, ahead("").result.hash);
  const Seen seen = ahead(slow + event(3, "restart"));
  for (std::size_t i = 400; i < seen.speeds.size(); ++i) EXPECT_LT(seen.speeds[i], 0.101) << i;
  EXPECT_GT(seen.speeds[280], 0.15);
}

TEST(GuardEvents, WhatAGuardDoesNotHaveIsRefused) {
  const Seen seen = ahead(event(2, "cancel") + event(2, "correct") + event(2, "place"));
  EXPECT_EQ(seen.result.events->refused, 3U);
  EXPECT_EQ(seen.result.hash, ahead("").result.hash);
}

TEST(GuardEvents, ATableIsThatOfTheAssistFromTheNextRestartOn) {
  const Seen seen = ahead(event(2, "table", "name = \"default\"\n") + event(3, "restart"));
  EXPECT_EQ(seen.result.events->played, 2U);
  EXPECT_EQ(ahead(event(2, "table", "file = \"none\"\n")).result.events->refused, 1U);
}

}  // namespace
}  // namespace whisker::guard
