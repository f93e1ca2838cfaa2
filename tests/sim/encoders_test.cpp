#include "host/sim/encoders.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/sim/fixes.hpp"

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

}  // namespace
}  // namespace whisker::sim
