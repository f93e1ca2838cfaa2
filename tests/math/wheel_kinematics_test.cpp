#include "firmware/math/wheel_kinematics.hpp"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "firmware/control/wheel_drive.hpp"

namespace whisker {
namespace {

Speed um_per_s(std::int32_t x) { return Speed::from_raw(x); }

TEST(Mixer, KeepsCurvatureWhereAWheelSaturates) {
  const Speed top = um_per_s(300000);
  for (std::int32_t forward = -700000; forward <= 700000; forward += 9973) {
    for (std::int32_t turning = -700000; turning <= 700000; turning += 9967) {
      const WheelPair w = inverse_kinematics(um_per_s(forward), um_per_s(turning), top);
      ASSERT_LE(abs(w.left), top);
      ASSERT_LE(abs(w.right), top);
      const double left = forward - turning;
      const double right = forward + turning;
      const double peak = std::fmax(std::fabs(left), std::fabs(right));
      const double k = peak > 300000 ? 300000 / peak : 1;
      ASSERT_NEAR(w.left.raw(), left * k, 0.51) << forward << ' ' << turning;
      ASSERT_NEAR(w.right.raw(), right * k, 0.51) << forward << ' ' << turning;
      const WheelPair mirrored = inverse_kinematics(um_per_s(forward), um_per_s(-turning), top);
      ASSERT_EQ(mirrored.left, w.right);
      ASSERT_EQ(mirrored.right, w.left);
    }
  }
}

TEST(Mixer, SlewReachesItsTargetWithoutPassingTheLimitOrTheTarget) {
  const Speed change = um_per_s(10000);
  WheelPair now{um_per_s(-123457), um_per_s(300000)};
  const WheelPair want{um_per_s(250001), um_per_s(-7)};
  int ticks = 0;
  while (now.left != want.left || now.right != want.right) {
    const WheelPair next = slew(now, want, change);
    ASSERT_LE(abs(next.left - now.left), change);
    ASSERT_LE(abs(next.right - now.right), change);
    ASSERT_GE(next.left, now.left);
    ASSERT_LE(next.right, now.right);
    now = next;
    ASSERT_LT(++ticks, 100);
  }
  EXPECT_EQ(ticks, 38);  // 373,458 um/s at 10,000 per tick
}

TEST(Mixer, SlewMovesBothWheelsByTheSameFraction) {
  const WheelPair next = slew({}, {um_per_s(100000), um_per_s(50000)}, um_per_s(10000));
  EXPECT_EQ(next.left, um_per_s(10000));
  EXPECT_EQ(next.right, um_per_s(5000));
}

TEST(Mixer, TheWireRoundsToNearestAndSaturates) {
  EXPECT_EQ(control::to_wire({um_per_s(149), um_per_s(-149)}).left, 1);
  EXPECT_EQ(control::to_wire({um_per_s(149), um_per_s(-149)}).right, -1);
  EXPECT_EQ(control::to_wire({um_per_s(150), um_per_s(-150)}).left, 2);
  EXPECT_EQ(control::to_wire({um_per_s(150), um_per_s(-150)}).right, -2);
  EXPECT_EQ(control::to_wire({um_per_s(INT32_MAX), um_per_s(INT32_MIN)}).left, INT16_MAX);
  EXPECT_EQ(control::to_wire({um_per_s(INT32_MAX), um_per_s(INT32_MIN)}).right, INT16_MIN);
}

}  // namespace
}  // namespace whisker
