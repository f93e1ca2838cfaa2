#include "host/harness/sim/motion.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <vector>

#include "host/harness/sim/wheel.hpp"
#include "tests/sim/generators.hpp"

namespace whisker::sim {
namespace {

constexpr double kPiHere = 3.14159265358979323846;

Sweep swept(const WorldView& world, const Arc& arc, double duration, double radius) {
  const double gap = clearance(world, arc.from.at, 0, radius);
  return sweep(world, arc, 0, duration, radius, gap, gap);
}

TEST(Arc, IsACircleOfItsRadius) {
  EXPECT_TRUE(rc::check([] {
    const Pose from{point(3), real(-10, 10)};
    const double length = real(-2, 2), turn = real(-6, 6), f = real(0, 1);
    RC_PRE(std::fabs(turn) > 1e-3);
    const double radius = length / turn, heading = from.heading + turn * f;
    const Pose to = along({from, length, turn}, f);
    RC_ASSERT(std::fabs(to.at.x - (from.at.x + radius * (std::sin(heading) - std::sin(from.heading)))) <
              1e-11);
    RC_ASSERT(std::fabs(to.at.y - (from.at.y - radius * (std::cos(heading) - std::cos(from.heading)))) <
              1e-11);
    RC_ASSERT(std::fabs(to.heading - heading) < 1e-12);
  }));
}

TEST(Arc, WithoutATurnIsALine) {
  const Pose to = along({{{1, 2}, kPiHere / 6}, -0.4, 0}, 0.5);
  EXPECT_NEAR(to.at.x, 1 - 0.2 * std::cos(kPiHere / 6), 1e-15);
  EXPECT_NEAR(to.at.y, 2 - 0.1, 1e-15);
}

TEST(Arc, ManyShortOnesCloseAFullCircle) {
  Pose pose{{1, 0}, kPiHere / 2};
  for (int i = 0; i < 3600; ++i) pose = along({pose, 2 * kPiHere / 3600, 2 * kPiHere / 3600}, 1);
  EXPECT_NEAR(pose.at.x, 1, 1e-12);
  EXPECT_NEAR(pose.at.y, 0, 1e-12);
  EXPECT_NEAR(pose.heading, 2.5 * kPiHere, 1e-12);
}

TEST(Sweep, StopsStraightMotionAtADiscWhereTheQuadraticSays) {
  EXPECT_TRUE(rc::check([] {
    const double body = real(0.02, 0.3);
    const Disc disc{point(1), real(0.005, 0.4)};
    const Pose from{point(1), real(-4, 4)};
    const double length = real(0.001, 1.5);
    const double touch = disc.radius + body;
    const Vec2 u{std::cos(from.heading), std::sin(from.heading)}, q = disc.center - from.at;
    RC_PRE(std::hypot(q.x, q.y) > touch + 1e-6);

    const double off = std::fabs(cross(u, q));
    const double s = dot(u, q) - std::sqrt(std::fmax(0.0, touch * touch - off * off));
    RC_PRE(std::fabs(off - touch) > 1e-6);
    const bool hit = off < touch && s > 0 && s < length;
    RC_CLASSIFY(hit, "hit");
    const Sweep got = swept({&disc, 1, nullptr, 0, nullptr, 0}, {from, length, 0}, 1, body);
    RC_ASSERT(got.contact == hit);
    if (hit) {
      // At a grazing angle, a gap of kContactGap is a longer distance along the path.
      const double steepness = std::sqrt(touch * touch - off * off) / touch;
      RC_ASSERT(std::fabs(got.fraction * length - s) < 3 * kContactGap / steepness);
      RC_ASSERT(got.clearance >= 0 && got.clearance <= 3 * kContactGap);
    } else {
      const double nearest = std::fmin(std::fmax(dot(u, q), 0.0), length);
      const double least = std::hypot(dot(u, q) - nearest, off) - touch;
      RC_ASSERT(got.fraction == 1.0);
      RC_ASSERT(got.least_clearance >= least - 1e-9 && got.least_clearance <= least + kClearanceSlack);
    }
  }));
}

TEST(Sweep, AgreesWithTinyStepsAlongAnArcAmongAllShapes) {
  EXPECT_TRUE(rc::check([] {
    const double body = real(0.02, 0.1);
    const std::vector<Disc> discs{{point(0.5), real(0.005, 0.1)}};
    const std::vector<Segment> segments{{point(0.5), point(0.5)}};
    const std::vector<Vec2> path{point(0.5), point(0.5)};
    const MovingDisc mover{path.data(), 2, real(0.005, 0.1), real(0, 1), 0};
    const WorldView world{discs.data(), 1, segments.data(), 1, &mover, 1};
    const Arc arc{{point(0.5), real(-4, 4)}, real(-0.3, 0.3), real(-3, 3)};
    RC_PRE(clearance(world, arc.from.at, 0, body) > 1e-6);

    constexpr int kSteps = 5000;
    const double step = (std::fabs(arc.length) + mover.speed) / kSteps;
    double least = 1e9;
    double contact = 2;
    for (int i = 0; i <= kSteps && contact > 1; ++i) {
      const double f = double{1} * i / kSteps;
      const double gap = clearance(world, along(arc, f).at, f, body);
      if (gap <= 0) contact = f;
      least = std::fmin(least, gap);
    }
    const Sweep got = swept(world, arc, 1, body);
    RC_CLASSIFY(got.contact, "contact");
    // A gap smaller than one tiny step may count as contact or not.
    if (contact <= 1) {
      RC_ASSERT(got.contact);
      RC_ASSERT(got.fraction <= contact);
    } else if (least > step) {
      RC_ASSERT(!got.contact);
    }
    if (!got.contact) {
      RC_ASSERT(got.least_clearance <= least + kClearanceSlack);
      RC_ASSERT(got.least_clearance >= least - step);
    } else {
      const double gap = clearance(world, along(arc, got.fraction).at, got.fraction, body);
      RC_ASSERT(gap > 0 && gap <= 3 * kContactGap);
    }
  }));
}

TEST(Sweep, AGrazingPassIsAContactExactlyIfTheGapCloses) {
  // The body passes a disc, a wall's end and a parallel wall, each at this distance in metres.
  for (const double miss : {-1e-3, -1e-6, -1e-7, -1e-8, 1e-8, 1e-7, 1e-6, 1e-3}) {
    const double body = 0.09;
    const Arc arc{{{-0.2137, 0}, 0}, 0.4, 0};
    const Disc disc{{0, body + 0.05 + miss}, 0.05};
    const Segment end{{0, body + miss}, {0, 1}};
    const Segment alongside{{0, body + miss}, {9, body + miss}};
    const WorldView worlds[] = {{&disc, 1, nullptr, 0, nullptr, 0},
                                {nullptr, 0, &end, 1, nullptr, 0},
                                {nullptr, 0, &alongside, 1, nullptr, 0}};
    for (const WorldView& world : worlds) {
      const Sweep got = swept(world, arc, 1, body);
      EXPECT_EQ(got.contact, miss < 0) << miss;
      if (miss > 0) {
        EXPECT_NEAR(got.least_clearance, miss, kClearanceSlack) << miss;
      }
    }
  }
}

TEST(Sweep, ABodySmallerThanItsStepDoesNotJumpAThinWall) {
  for (const double body : {1e-4, 1e-3, 0.02}) {
    for (const double angle : {0.0, 0.7, 1.4, 1.55}) {
      const Segment wall{{0.1, -9}, {0.1, 9}};
      const Arc arc{{{0, 0}, angle}, 10, 0};  // one step of 10 m: no speed may tunnel
      const Sweep got = swept({nullptr, 0, &wall, 1, nullptr, 0}, arc, 1, body);
      const double way = (0.1 - body) / std::cos(angle);
      EXPECT_EQ(got.contact, way < 10) << body << ' ' << angle;
      EXPECT_NEAR(got.fraction * 10, way, 3 * kContactGap / std::cos(angle)) << body << ' ' << angle;
    }
  }
}

TEST(Sweep, AMoverRunsIntoARestingBody) {
  const Vec2 path[] = {{1, 0}, {0, 0}};
  const MovingDisc mover{path, 2, 0.1, 0.5, 0};
  const Sweep got = swept({nullptr, 0, nullptr, 0, &mover, 1}, {{{0, 0}, 0}, 0, 0}, 2, 0.09);
  EXPECT_TRUE(got.contact);
  EXPECT_NEAR(got.fraction * 2, (1 - 0.19) / 0.5, 1e-8);
}

TEST(Sweep, TurningOnTheSpotTouchesNothing) {
  const Segment wall{{0.0901, -1}, {0.0901, 1}};
  const Sweep got = swept({nullptr, 0, &wall, 1, nullptr, 0}, {{{0, 0}, 0}, 0, 6}, 1, 0.09);
  EXPECT_FALSE(got.contact);
  EXPECT_NEAR(got.least_clearance, 1e-4, 1e-15);
}

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
