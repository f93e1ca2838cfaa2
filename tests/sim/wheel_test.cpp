#include "host/sim/wheel.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "tests/sim/generators.hpp"

namespace whisker::sim {
namespace {

/// The definition itself, in steps so short that the trapezoidal rule is exact to 1e-8.
WheelStep by_small_steps(double lag, double limit, double time, double v, double target) {
  constexpr int kSteps = 20000;
  const double dt = time / kSteps;
  const auto acceleration = [&](double speed) {
    return std::fmax(-limit, std::fmin(limit, (target - speed) / lag));
  };
  WheelStep s{v, 0};
  for (int i = 0; i < kSteps; ++i) {
    const double first = acceleration(s.speed);
    const double mean = 0.5 * (first + acceleration(s.speed + first * dt));
    s.distance += (s.speed + 0.5 * mean * dt) * dt;
    s.speed += mean * dt;
  }
  return s;
}

TEST(Wheel, FollowsItsDifferentialEquation) {
  EXPECT_TRUE(rc::check([] {
    const double lag = real(0.01, 0.5), limit = real(0.05, 20), time = real(0.001, 0.5);
    const double v = real(-3, 3), target = real(-3, 3);
    const WheelStep got = WheelModel(lag, limit, time).step(v, target);
    const WheelStep expected = by_small_steps(lag, limit, time, v, target);
    RC_ASSERT(std::fabs(got.speed - expected.speed) < 1e-6);
    RC_ASSERT(std::fabs(got.distance - expected.distance) < 1e-6);
  }));
}

TEST(Wheel, StepResponseOfTheReferenceRobotIsARampThenAnExponential) {
  // From rest to 0.3 m/s: limited to 1 m/s^2 until 0.05 m/s are left, at 0.25 s, then the lag of 50 ms.
  const WheelModel wheel(0.05, 1.0, 0.002);
  WheelStep s{0, 0};
  double distance = 0;
  for (int i = 1; i <= 400; ++i) {
    s = wheel.step(s.speed, 0.3);
    distance += s.distance;
    const double t = 0.002 * i;
    const double tail = std::exp(-(t - 0.25) / 0.05);
    const double v = t <= 0.25 ? t : 0.3 - 0.05 * tail;
    const double x = t <= 0.25 ? t * t / 2 : 0.03125 + 0.3 * (t - 0.25) - 0.0025 * (1 - tail);
    ASSERT_NEAR(s.speed, v, 1e-13) << t;
    ASSERT_NEAR(distance, x, 1e-13) << t;
  }
}

TEST(Wheel, TheLengthOfTheStepsDoesNotMatter) {
  EXPECT_TRUE(rc::check([] {
    const double lag = real(0, 0.5), limit = real(0.05, 20), step = real(0.0005, 0.01);
    const int parts = *rc::gen::inRange(2, 20);
    const double v = real(-3, 3), target = real(-3, 3);
    const WheelStep whole = WheelModel(lag, limit, step * parts).step(v, target);
    const WheelModel part(lag, limit, step);
    WheelStep s{v, 0};
    double distance = 0;
    for (int i = 0; i < parts; ++i) {
      s = part.step(s.speed, target);
      distance += s.distance;
    }
    RC_ASSERT(std::fabs(whole.speed - s.speed) < 1e-11);
    RC_ASSERT(std::fabs(whole.distance - distance) < 1e-11);
  }));
}

TEST(Wheel, NeverLeavesTheIntervalFromItsSpeedToTheTargetNorExceedsItsAcceleration) {
  EXPECT_TRUE(rc::check([] {
    const double lag = *rc::gen::element(0.0, 0.05, 0.5), limit = real(0.05, 20);
    const double step = 0.001 * *rc::gen::inRange(1, 3);
    const WheelModel wheel(lag, limit, step);
    double v = real(-3.2767, 3.2767);
    const double target = real(-3.2767, 3.2767);
    for (int i = 0; i < 100; ++i) {
      const double before = v;
      v = wheel.step(v, target).speed;
      RC_ASSERT(std::fmin(before, target) <= v && v <= std::fmax(before, target));
      RC_ASSERT(std::fabs(v - before) <= limit * step + 1e-12);
    }
  }));
}

TEST(Wheel, EndsOnItsTargetAfterAWholeNumberOfLimitedSteps) {
  for (const double limit : {0.1, 0.3, 0.7, 1.1}) {
    for (int steps = 1; steps <= 300; ++steps) {
      const WheelModel wheel(0, limit, 0.002);
      const double target = limit * 0.002 * steps;
      double v = 0;
      for (int i = 0; i < steps + 1; ++i) {
        v = wheel.step(v, target).speed;
        ASSERT_LE(v, target) << limit << ' ' << steps;
      }
      ASSERT_EQ(v, target);
    }
  }
}

TEST(Wheel, RoundingDoesNotCarryALimitedStepBeyondItsTarget) {
  const double limit = 0x1.28059e44af227p+4, v = -0x1.f7e633f3b89cp-5, target = -0x1.918ba6d7b4871p-6;
  ASSERT_GT(v + limit * 0.002, target);
  EXPECT_EQ(WheelModel(0, limit, 0.002).step(v, target).speed, target);
}

TEST(Wheel, ComesToAnExactStop) {
  const WheelModel wheel(0.5, 1.0, 0.002);
  double v = 0.3;
  int steps = 0;
  while (v != 0 && steps < 100000) {
    v = wheel.step(v, 0).speed;
    ++steps;
  }
  // 0.5 s of log(0.3 / 1e-12) in steps of 2 ms.
  EXPECT_NEAR(steps, 0.5 * std::log(0.3e12) / 0.002, 2);
}

TEST(Wheel, WithoutLagItTakesTheTargetAtOnceWithinItsAcceleration) {
  const WheelModel wheel(0, 10, 0.01);
  EXPECT_EQ(wheel.step(0, 0.05).speed, 0.05);
  EXPECT_DOUBLE_EQ(wheel.step(0, 0.05).distance, 0.05 * 0.01 - 0.05 * 0.005 / 2);
  EXPECT_DOUBLE_EQ(wheel.step(0, -3).speed, -0.1);
}

}  // namespace
}  // namespace whisker::sim
