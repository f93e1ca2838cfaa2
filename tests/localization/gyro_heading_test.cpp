#include "firmware/localization/gyro_heading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "firmware/localization/pose_bound.hpp"

namespace whisker::localization {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;
constexpr double kDegree = kHalfTurn / 180;

Params params_of_gyro_test(int counts_per_metre) {
  Params p;
  p.wheels.counts_per_metre = counts_per_metre;
  p.gyro.fitted = Fitted::yes;
  return p;
}

/// A body whose speeds the test sets, ticks of 10 ms, with errors of wheels and gyro.
class GyroHeadingTest : public testing::Test {
 protected:
  explicit GyroHeadingTest(int counts_per_metre = 5000) : params_(params_of_gyro_test(counts_per_metre)) {
    odometry_.configure(params_);
    odometry_.place({});
    bound_.configure(params_);
    heading_.configure(params_, odometry_);
    heading_.restart();
    CountStep step;
    odometry_.take(counts(), 10_ms, step);
  }

  /// Rolls for this time; the gyro sample of a tick is read one tick later.
  void drive(double seconds, double forward_mps, double turn_radps) {
    const int ticks = static_cast<int>(std::lround(seconds * 100));
    for (int i = 0; i < ticks; ++i) {
      true_ += turn_radps * 0.01;
      const double arc = turn_radps * 0.01 * 0.07;
      way_[0] += forward_mps * 0.01 - arc;
      way_[1] += (forward_mps * 0.01 + arc) * (1 - slip_right);
      // What slips does not turn the body.
      true_ -= slip_right * (forward_mps * 0.01 + arc) / 0.14;
      rolled_[0] += (forward_mps * 0.01 - arc) * scale[0];
      rolled_[1] += (forward_mps * 0.01 + arc) * scale[1];
      const double rate = turn_radps - slip_right * (forward_mps + turn_radps * 0.07) / 0.14;
      sample(rate + bias_dps * kDegree);
      tick(!coasts && (forward_mps != 0 || turn_radps != 0));
    }
  }
  /// From this rate to rest with the motor's lag, without a command.
  void coast(double turn_radps) {
    coasts = true;
    for (int i = 0; i < 100; ++i) drive(0.01, 0, turn_radps * std::exp(-i / 5.0));
    coasts = false;
  }
  void tick(bool commanded) {
    elapsed_ += 10_ms;
    if (skip_ticks > 0) {
      --skip_ticks;
      return;
    }
    CountStep step;
    ASSERT_TRUE(odometry_.take(counts(), elapsed_, step));
    const GyroHeading::Step in{answers ? &shown_ : nullptr, step, commanded, elapsed_};
    odometry_.advance(step, heading_.turn(in, odometry_, health_));
    bound_.step({odometry_.pose(), step, elapsed_, heading_.source() == HeadingSource::gyro});
    GyroBias::Mean mean;
    if (heading_.bias().take(params_.gyro, mean)) bound_.rest(mean, params_, heading_.bias());
    elapsed_ = Duration{};
  }
  void sample(double rate) {
    shown_ = next_;
    const double units = std::round(rate * gyro_scale / (8.726646 / 32768));
    const double held = std::fmin(32767, std::fmax(-32767, units));
    next_.sum += static_cast<std::uint32_t>(static_cast<std::int32_t>(held));
    ++next_.samples;
    if (held != units) ++next_.saturated;
  }
  hal::EncoderCounts counts() const {
    const int per_metre = params_.wheels.counts_per_metre;
    const auto of = [per_metre](double way) {
      return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(way * per_metre)) & 0xFFFFFF);
    };
    return {of(rolled_[0]), of(rolled_[1])};
  }
  /// Of the estimate, degrees.
  double error() const {
    const double estimate = odometry_.pose().heading.wrapped() * (kHalfTurn / 2147483648.0);
    return std::remainder(estimate - true_, 2 * kHalfTurn) / kDegree;
  }
  void rest(double seconds) { drive(seconds, 0, 0); }
  /// The error of each wheel, in millionths.
  void declare(int ppm) {
    params_.pose_error.wheel_scale = millionths(ppm);
    heading_ = {};
    heading_.configure(params_, odometry_);
  }
  /// The sum of the samples jumps.
  void leap(std::uint32_t by) { next_.sum += by; }
  /// Several metres and turns, ending at rest.
  void wander(int legs) {
    for (int i = 0; i < legs; ++i) {
      drive(4, 0.25, 0);
      rest(0.1);
      drive(1, 0, i % 3 == 0 ? -1.5 : 1.2);
      rest(0.1);
    }
  }

  Params params_;
  Odometry odometry_;
  PoseBound bound_;
  GyroHeading heading_;
  Health health_;

  double scale[2] = {1, 1};
  double bias_dps = 1.3;
  double gyro_scale = 1;
  double slip_right = 0;
  bool answers = true;
  bool coasts = false;
  int skip_ticks = 0;

 private:
  double true_ = 0;
  double way_[2] = {0, 0};
  double rolled_[2] = {0, 0};
  hal::GyroReading next_{}, shown_{};
  Duration elapsed_;
};

TEST_F(GyroHeadingTest, MeasuresItsBiasInTwoSecondsOfRestAndThenTurnsByTheGyro) {
  scale[1] = 1.02;
  EXPECT_EQ(heading_.source(), HeadingSource::bias_unknown);
  EXPECT_TRUE(heading_.wants_rest());
  rest(2.0);
  EXPECT_EQ(heading_.source(), HeadingSource::bias_unknown) << "150 ms do not count";
  rest(0.3);
  EXPECT_EQ(heading_.source(), HeadingSource::gyro);
  EXPECT_FALSE(heading_.wants_rest());
  wander(10);
  EXPECT_NEAR(error(), 0, 0.3);
  EXPECT_EQ(health_.wheel_slips, 0U);
}

TEST_F(GyroHeadingTest, WaitsLongerAfterTheLastCountTheCoarserTheCounts) {
  const auto wait = [this](int counts_per_metre, Duration lag) {
    params_.wheels.counts_per_metre = counts_per_metre;
    params_.wheels.motor_lag = lag;
    GyroBias bias;
    bias.configure(params_);
    Duration waited;
    for (; !bias.rests(); waited += 1_ms) bias.pass(true, 1_ms);
    return waited - 1_ms;
  };
  EXPECT_EQ(wait(20000, 50_ms), 150_ms);
  EXPECT_EQ(wait(5000, 50_ms), 150_ms);
  EXPECT_EQ(wait(676, 50_ms), 255_ms) << "three halvings to 0.2 mm";
  EXPECT_EQ(wait(100, 50_ms), 360_ms);
  EXPECT_EQ(wait(100, 0_ms), 150_ms) << "a stepper stands at once";
  EXPECT_EQ(wait(5000, 500_ms), 2850_ms);
  EXPECT_EQ(wait(100, 500_ms), 2850_ms);
}

class CoarseCounts : public GyroHeadingTest, public testing::WithParamInterface<int> {
 protected:
  CoarseCounts() : GyroHeadingTest(GetParam()) {}
};

// The body still turns when the last count has come. If that is taken for bias, its heading leaves.
TEST_P(CoarseCounts, WhatRollsOnAfterTheLastIsNoBias) {
  rest(2.5);
  for (int i = 0; i < 30; ++i) {
    drive(1.5, 0, 1.2);
    coast(0.8);
  }
  EXPECT_NEAR(error(), 0, 0.5);
}

INSTANTIATE_TEST_SUITE_P(PerMetre, CoarseCounts, testing::Values(5000, 700, 200, 100));

TEST_F(GyroHeadingTest, UsesTheScaleOfTheParameters) {
  params_.gyro.scale = millionths(1030000);
  heading_.configure(params_, odometry_);
  gyro_scale = 1 / 1.03;
  rest(2.5);
  drive(10, 0, 1.5);
  rest(0.1);
  EXPECT_NEAR(error(), 0, 0.1);
}

TEST_F(GyroHeadingTest, MissedTicksLoseNothing) {
  rest(2.5);
  for (int i = 0; i < 20; ++i) {
    skip_ticks = i % 5;
    drive(0.2, 0.1, 1.7);
  }
  rest(0.1);
  EXPECT_NEAR(error(), 0, 0.1);
  EXPECT_EQ(health_.gyro_lost, 0U);
}

TEST_F(GyroHeadingTest, TakesTheTurnOfTheWheelsBackWhenSamplesArriveLate) {
  scale[0] = 0.9;
  rest(2.5);
  for (int i = 0; i < 20; ++i) {
    answers = false;
    drive(0.08, 0.2, 1.0);
    answers = true;
    drive(0.2, 0.2, 1.0);
  }
  rest(0.1);
  EXPECT_NEAR(error(), 0, 0.1);
  EXPECT_EQ(health_.gyro_lost, 0U);
}

TEST_F(GyroHeadingTest, TheWheelsTurnThePoseAsTheGyroTaughtThemOnceItIsSilent) {
  declare(10000);
  scale[0] = 0.985;
  scale[1] = 1.012;
  rest(2.5);
  wander(6);
  answers = false;
  wander(6);
  EXPECT_EQ(heading_.source(), HeadingSource::gyro_lost);
  EXPECT_EQ(health_.gyro_lost, 1U);
  EXPECT_FALSE(heading_.wants_rest());
  // Untaught wheels turn by 11 degrees on each metre, 66 in all.
  EXPECT_NEAR(error(), 0, 3);
  answers = true;
  const double before = error();
  wander(6);
  EXPECT_EQ(heading_.source(), HeadingSource::gyro);
  EXPECT_NEAR(error(), before, 0.5);
}

TEST_F(GyroHeadingTest, WhatASilentGyroTaughtTurnsThePoseNoFurtherThanTheDeclaredErrors) {
  for (const int ppm : {0, 1000}) {
    declare(ppm);
    scale[0] = 0.96;
    answers = true;
    rest(2.5);
    wander(6);
    answers = false;
    drive(0.2, 0.25, 0);
    const double before = error();
    drive(8, 0.25, 0);
    const double untaught = 2 * 0.04 / 0.14 / kDegree;
    const double most = 2 * 2 * 3 * 0.000707 * ppm / 1000 / 0.14 / kDegree;
    EXPECT_NEAR(error() - before, untaught - most, 0.4) << ppm;
  }
}

TEST_F(GyroHeadingTest, ASumThatItsSamplesCannotHaveTurnsNothing) {
  rest(2.5);
  drive(1, 0, 1);
  const double before = error();
  leap(0x7FFF0000U);
  drive(0.5, 0.1, 0);
  leap(0x80000000U);
  rest(3);
  EXPECT_NEAR(error(), before, 0.3);
  EXPECT_NEAR(heading_.bias().value() / 65536.0 * (500.0 / 32768), bias_dps, 0.02);
}

TEST_F(GyroHeadingTest, ASaturatedSampleIsReplacedByTheWheels) {
  rest(2.5);
  drive(0.5, 0, 10);
  rest(0.2);
  EXPECT_NEAR(error(), 0, 6) << "the latency; the gyro alone would lack 36 degrees";
  EXPECT_GE(health_.gyro_saturated, 49U);
  EXPECT_EQ(heading_.source(), HeadingSource::gyro);
}

TEST_F(GyroHeadingTest, CountsAWheelThatSlips) {
  rest(2.5);
  wander(6);
  EXPECT_EQ(health_.wheel_slips, 0U);
  slip_right = 0.3;
  drive(0.25, 0.25, 0);
  slip_right = 0;
  drive(2, 0.25, 0);
  EXPECT_EQ(health_.wheel_slips, 1U);
  wander(6);
  EXPECT_EQ(health_.wheel_slips, 1U);
  EXPECT_NEAR(error(), 0, 0.3);
}

TEST_F(GyroHeadingTest, WantsASecondOfRestAfterAMinute) {
  rest(2.5);
  for (int i = 0; i < 12; ++i) {
    EXPECT_FALSE(heading_.wants_rest()) << i;
    drive(5.1, 0.1, 0);
  }
  EXPECT_TRUE(heading_.wants_rest());
  bias_dps = 1.4;  // it has warmed up
  rest(1.1);
  EXPECT_TRUE(heading_.wants_rest());
  rest(0.2);
  EXPECT_FALSE(heading_.wants_rest());
  const double before = error();
  drive(20, 0.1, 0);
  EXPECT_NEAR(error(), before, 20 * 0.05);
}

TEST_F(GyroHeadingTest, MotionThatTheWheelsDoNotCountYetIsNotTakenForBias) {
  rest(2.5);
  // The body still turns for 120 ms after the last count.
  drive(1, 0.2, 0);
  for (int i = 0; i < 12; ++i) {
    sample((bias_dps + 2) * kDegree);
    tick(false);
  }
  rest(1);
  EXPECT_NEAR(heading_.bias().value() / 65536.0 * (500.0 / 32768), bias_dps, 0.02);
}

TEST_F(GyroHeadingTest, ASlowMotorTurnsTheBodyForLongerAfterTheLastCount) {
  params_.wheels.motor_lag = 150_ms;
  heading_ = {};
  heading_.configure(params_, odometry_);
  rest(3.5);
  for (int stop = 0; stop < 20; ++stop) {
    drive(1, 0.2, 0);
    for (int i = 0; i < 45; ++i) {
      sample((bias_dps + 2) * kDegree);
      tick(false);
    }
    rest(0.4);
  }
  EXPECT_NEAR(heading_.bias().value() / 65536.0 * (500.0 / 32768), bias_dps, 0.02);
}

TEST_F(GyroHeadingTest, ATurntableUnderStandingWheelsIsATurnAndNoBias) {
  rest(2.5);
  for (int i = 0; i < 300; ++i) {
    sample((bias_dps + 30) * kDegree);
    tick(false);
  }
  EXPECT_NEAR(error(), 90, 1);
  EXPECT_NEAR(heading_.bias().value() / 65536.0 * (500.0 / 32768), bias_dps, 0.02);
}

}  // namespace
}  // namespace whisker::localization
