#include "host/sim/gyro.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace whisker::sim {
namespace {

constexpr double kRadPerDegree = kPi / 180;
constexpr double kGyroUnit = 8.72665 / 32768;  // rad/s

RobotSpec fitted() {
  RobotSpec robot;
  robot.gyro = true;
  return robot;
}

double signed_sum(const hal::GyroReading& r) { return static_cast<std::int32_t>(r.sum); }

/// Turns at a constant rate in steps of 2 ms.
struct Turntable {
  Gyro gyro;
  std::int64_t now_us = 0;
  void turn(double rate, double seconds) {
    const std::int64_t steps = std::llround(seconds * 500);
    for (std::int64_t i = 0; i < steps; ++i, now_us += 2000) gyro.turn(rate * 0.002, now_us, now_us + 2000);
  }
  hal::GyroReading reading() const { return gyro.read(now_us); }
};

TEST(Gyro, AddsUpTheMeanRateOfEverySample) {
  Turntable t{{fitted(), {}, 1}};
  t.turn(1.0, 2);
  t.turn(-0.5, 1);
  t.turn(0, 0.01);  // the latency of the last sample
  EXPECT_EQ(t.reading().samples, 300);
  EXPECT_NEAR(signed_sum(t.reading()) * kGyroUnit * 0.01, 1.5, 300 * kGyroUnit * 0.01 / 2);
  EXPECT_EQ(t.reading().saturated, 0);
}

TEST(Gyro, LosesNothingWhereASampleEndsWithinAStep) {
  RobotSpec robot = fitted();
  robot.gyro_rate_hz = 130;
  Turntable t{{robot, {}, 1}};
  t.turn(1.0, 3);
  t.turn(0, 0.5);
  EXPECT_NEAR(signed_sum(t.reading()) * kGyroUnit / 130, 3.0, 390 * kGyroUnit / 130 / 2);
}

TEST(Gyro, ASampleArrivesAfterItsLatency) {
  Turntable t{{fitted(), {}, 1}};
  t.turn(1.0, 0.018);
  EXPECT_EQ(t.reading().samples, 0);
  t.turn(1.0, 0.002);
  EXPECT_EQ(t.reading().samples, 1);
}

TEST(Gyro, SaturatesAtItsRangeAndCountsIt) {
  Turntable t{{fitted(), {}, 1}};
  t.turn(-9.0, 0.05);
  t.turn(0, 0.01);
  EXPECT_EQ(t.reading().saturated, 5);
  EXPECT_EQ(signed_sum(t.reading()), -5.0 * 32767);
}

TEST(Gyro, WarmsUpLinearlyForTenMinutes) {
  NoiseSpec noise;
  noise.gyro_warm_up_radps = 20 * kRadPerDegree;
  Turntable t{{fitted(), noise, 3}};
  double sums[3] = {};
  for (double& sum : sums) {
    const double before = signed_sum(t.reading());
    t.turn(0, 300);
    sum = signed_sum(t.reading()) - before;
  }
  // The mean bias of the three stretches is 1/4, 3/4 and 1 of the whole change.
  ASSERT_GT(std::fabs(sums[2]), 1e6) << "rounding does not matter";
  EXPECT_NEAR(sums[0] / sums[2], 0.25, 0.01);
  EXPECT_NEAR(sums[1] / sums[2], 0.75, 0.01);
}

TEST(Gyro, ErrorsHaveTheirSigmas) {
  constexpr int kRuns = 2000;
  NoiseSpec noise;
  noise.gyro_bias_radps = 1 * kRadPerDegree;
  noise.gyro_walk_rad_per_sqrt_s = 0.4 * kRadPerDegree / 60;
  NoiseSpec scaled;
  scaled.gyro_scale_sigma = 0.01;
  double bias2 = 0, walk2 = 0, scale2 = 0;
  for (int seed = 0; seed < kRuns; ++seed) {
    Turntable t{{fitted(), noise, static_cast<std::uint64_t>(seed)}};
    t.turn(0, 1.01);
    const double first = signed_sum(t.reading()) * kGyroUnit * 0.01;
    t.turn(0, 1);
    const double second = signed_sum(t.reading()) * kGyroUnit * 0.01 - first;
    bias2 += first * first;
    walk2 += (second - first) * (second - first) / 2;  // the bias cancels
    Turntable s{{fitted(), scaled, static_cast<std::uint64_t>(seed)}};
    s.turn(1, 1.01);
    const double error = signed_sum(s.reading()) * kGyroUnit * 0.01 - 1;
    scale2 += error * error;
  }
  // Four standard deviations of a standard deviation; seeds 0 to 1999.
  const double slack = 4 / std::sqrt(2.0 * kRuns);
  EXPECT_NEAR(std::sqrt(bias2 / kRuns) / noise.gyro_bias_radps, 1, slack);
  EXPECT_NEAR(std::sqrt(walk2 / kRuns) / noise.gyro_walk_rad_per_sqrt_s, 1, slack);
  EXPECT_NEAR(std::sqrt(scale2 / kRuns) / scaled.gyro_scale_sigma, 1, slack);
}

}  // namespace
}  // namespace whisker::sim
