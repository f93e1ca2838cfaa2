#include "firmware/planning/boundary/stuck_detector.hpp"

#include <gtest/gtest.h>

namespace whisker::planning {
namespace {

constexpr int32_t kTicks = 80;
constexpr Duration kPatience = milliseconds(10 * kTicks);

View driving(Speed forward, Q14 granted, Speed turning = {}) {
  View v;
  v.elapsed = milliseconds(10);
  v.forward = forward;
  v.granted = granted;
  v.turning = turning;
  return v;
}

const Q14 kAll = Q14::ratio(1, 1);
const Q14 kHalf = Q14::ratio(1, 2);
constexpr Speed kTurning = 100_mm_per_s;

/// Ticks until it reports; 1000: never.
int ticks(StuckDetector& stall, const View& v) {
  for (int n = 1; n < 1000; ++n) {
    if (stall.stalled(v, kPatience, Params{})) return n;
  }
  return 1000;
}

TEST(StuckDetector, IsPatientWithABodyThatIsSlow) {
  StuckDetector stall;
  EXPECT_EQ(ticks(stall, driving({}, kAll)), kTicks);
  stall.reset();
  EXPECT_EQ(ticks(stall, driving({}, kAll)), kTicks);
}

TEST(StuckDetector, NeedsFourTicksHoweverLongTheyAre) {
  StuckDetector stall;
  View held = driving({}, {});
  held.elapsed = kPatience;
  EXPECT_EQ(ticks(stall, held), 4);
}

TEST(StuckDetector, IsLessPatientWhereTheGuardHoldsBack) {
  StuckDetector stall;
  EXPECT_EQ(ticks(stall, driving({}, kHalf)), kTicks / 4);
  stall.reset();
  EXPECT_EQ(ticks(stall, driving({}, kHalf, kTurning)), kTicks) << "while it turns, readings show more";
  stall.reset();
  EXPECT_EQ(ticks(stall, driving({}, kHalf, -kTurning)), kTicks);
}

TEST(StuckDetector, BeginsAgainWhenTheBodyGetsOn) {
  StuckDetector stall;
  const View stands = driving({}, kAll);
  for (int n = 1; n < kTicks; ++n) ASSERT_FALSE(stall.stalled(stands, kPatience, Params{}));
  EXPECT_FALSE(stall.stalled(driving(200_mm_per_s, kHalf), kPatience, Params{}));
  EXPECT_EQ(ticks(stall, stands), kTicks);
  EXPECT_EQ(ticks(stall, driving(200_mm_per_s, kHalf)), 1000);
}

TEST(StuckDetector, ItsPatienceLeavesTimeToStart) {
  const Params reference;
  EXPECT_EQ(patience(reference), 800_ms) << "of which a time for which it is held counts four times";
  Params slow = reference;
  slow.rangefinders.rate_hz = 10;
  slow.wheels.motor_lag = 300_ms;
  EXPECT_GT(patience(slow), patience(reference) * 3);
  Params fine = reference;
  fine.safety.period = 5_ms;
  EXPECT_EQ(patience(fine), patience(reference));
}

}  // namespace
}  // namespace whisker::planning
