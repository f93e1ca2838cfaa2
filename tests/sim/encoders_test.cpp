#include "host/harness/sim/encoders.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/harness/sim/fixes.hpp"
#include "host/harness/sim/gyro.hpp"

namespace whisker::sim {
namespace {

RobotSpec with_counts(double counts_per_m) {
  RobotSpec robot;
  robot.counts_per_m = counts_per_m;
  return robot;
}

TEST(Encoders, CountWholeStepsDownwards) {
  Encoders encoders(with_counts(1000), {}, 1);
  encoders.roll(0.00199, -0.0001, 0.001);
  EXPECT_EQ(encoders.counts().left, 1U);
  EXPECT_EQ(encoders.counts().right, hal::kEncoderModulus - 1);
  encoders.roll(0.00002, -0.001, 0.001);
  EXPECT_EQ(encoders.counts().left, 2U);
  EXPECT_EQ(encoders.counts().right, hal::kEncoderModulus - 2);
}

TEST(Encoders, LoseNothingInManySmallRolls) {
  Encoders encoders(with_counts(5000), {}, 1);
  for (int i = 0; i < 100000; ++i) encoders.roll(0.00001, 0.00003, 0.00002);
  EXPECT_NEAR(encoders.counts().left, 5000, 1);
  EXPECT_NEAR(encoders.counts().right, 15000, 1);
}

TEST(Encoders, WrapAtTwoToTheTwentyFourBothWays) {
  Encoders encoders(with_counts(1024), {}, 1);
  const double turn = hal::kEncoderModulus / 1024.0;
  encoders.roll(turn - 0.5 / 1024, -turn + 0.5 / 1024, 0);
  EXPECT_EQ(encoders.counts().left, hal::kEncoderModulus - 1);
  EXPECT_EQ(encoders.counts().right, 0U);
  encoders.roll(1.0 / 1024, -1.0 / 1024, 0);
  EXPECT_EQ(encoders.counts().left, 0U);
  EXPECT_EQ(encoders.counts().right, hal::kEncoderModulus - 1);
}

TEST(Encoders, ScaleErrorsHaveTheirMeanAndSigmaAndAreIndependent) {
  constexpr int kRuns = 20000;
  constexpr double kSigma = 0.01;
  NoiseSpec noise;
  noise.wheel_scale_sigma = kSigma;
  double sum = 0, squares = 0, product = 0;
  for (int seed = 0; seed < kRuns; ++seed) {
    Encoders encoders(with_counts(1e6), noise, static_cast<std::uint64_t>(seed));
    encoders.roll(1, 1, 1);
    const double left = encoders.counts().left / 1e6 - 1, right = encoders.counts().right / 1e6 - 1;
    sum += left + right;
    squares += left * left + right * right;
    product += left * right;
  }
  // Four standard deviations of each estimate; seeds 0 to 19999.
  EXPECT_NEAR(sum / (2 * kRuns), 0, 4 * kSigma / std::sqrt(2.0 * kRuns));
  EXPECT_NEAR(std::sqrt(squares / (2 * kRuns)), kSigma, 4 * kSigma / std::sqrt(4.0 * kRuns));
  EXPECT_NEAR(product / kRuns, 0, 4 * kSigma * kSigma / std::sqrt(double{kRuns}));
}

TEST(Encoders, ACommonScaleErrorIsTheSameOnBothWheelsAndLeavesTheirOwn) {
  NoiseSpec own, common, both;
  own.wheel_scale_sigma = both.wheel_scale_sigma = 0.01;
  common.wheel_scale_common_sigma = both.wheel_scale_common_sigma = 0.02;
  constexpr int kRuns = 2000;
  double squares = 0;
  for (int seed = 0; seed < kRuns; ++seed) {
    double error[3][2] = {};
    int i = 0;
    for (const NoiseSpec& noise : {own, common, both}) {
      Encoders encoders(with_counts(1e6), noise, static_cast<std::uint64_t>(seed));
      encoders.roll(1, 1, 1);
      error[i][0] = encoders.counts().left / 1e6 - 1;
      error[i++][1] = encoders.counts().right / 1e6 - 1;
    }
    ASSERT_EQ(error[1][0], error[1][1]);
    ASSERT_NEAR(error[2][0], error[0][0] + error[1][0], 2e-6);
    ASSERT_NEAR(error[2][1], error[0][1] + error[1][1], 2e-6);
    squares += error[1][0] * error[1][0];
  }
  EXPECT_NEAR(std::sqrt(squares / kRuns), 0.02, 4 * 0.02 / std::sqrt(2.0 * kRuns));  // seeds 0 to 1999
}

TEST(Encoders, DriftTurnsTheOdometryByTheRootOfThePath) {
  constexpr int kRuns = 4000;
  constexpr double kDrift = 0.01;
  NoiseSpec noise;
  noise.heading_drift_rad_per_sqrt_m = kDrift;
  const RobotSpec robot = with_counts(1e6);
  for (const int metres : {1, 4}) {
    double sum = 0, squares = 0;
    for (int seed = 0; seed < kRuns; ++seed) {
      Encoders encoders(robot, noise, static_cast<std::uint64_t>(seed));
      for (int i = 0; i < 100 * metres; ++i) encoders.roll(0.01, 0.01, 0.01);
      const double left = encoders.counts().left / 1e6, right = encoders.counts().right / 1e6;
      EXPECT_NEAR(0.5 * (left + right), metres, 2e-6);
      const double heading = (right - left) / robot.track;
      sum += heading;
      squares += heading * heading;
    }
    const double sigma = kDrift * std::sqrt(double{1} * metres);
    EXPECT_NEAR(sum / kRuns, 0, 4 * sigma / std::sqrt(double{kRuns})) << metres;
    EXPECT_NEAR(std::sqrt(squares / kRuns), sigma, 4 * sigma / std::sqrt(2.0 * kRuns)) << metres;
  }
}

NoiseSpec fixes_every(double metres) {
  NoiseSpec noise;
  noise.fix_every_m = metres;
  noise.fix_sigma_m = 0.03;
  noise.fix_sigma_rad = 0.02;
  return noise;
}

TEST(Fixes, ComeOnceAfterEachWay) {
  Fixes fixes(fixes_every(2), 1);
  Pose fix;
  int come = 0;
  for (int i = 0; i <= 1000; ++i) come += fixes.take({}, i * 0.01, fix) ? 1 : 0;
  EXPECT_EQ(come, 5);
  EXPECT_FALSE(fixes.take({}, 10.0, fix));
}

TEST(Fixes, NoneWithoutAWay) {
  Fixes fixes(fixes_every(0), 1);
  Pose fix;
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(fixes.take({}, i, fix));
}

TEST(Fixes, AreTrueButForTheirErrors) {
  Fixes fixes(fixes_every(1), 7);
  const Pose truth{{3, -2}, 0.5};
  double x = 0, y = 0, turn = 0;
  constexpr int kFixes = 2000;
  for (int i = 1; i <= kFixes; ++i) {
    Pose fix;
    ASSERT_TRUE(fixes.take(truth, i, fix));
    x += std::pow(fix.at.x - truth.at.x, 2);
    y += std::pow(fix.at.y - truth.at.y, 2);
    turn += std::pow(fix.heading - truth.heading, 2);
  }
  EXPECT_NEAR(std::sqrt(x / kFixes), 0.03, 0.002);
  EXPECT_NEAR(std::sqrt(y / kFixes), 0.03, 0.002);
  EXPECT_NEAR(std::sqrt(turn / kFixes), 0.02, 0.0015);
}

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
