#include "host/sim/motion.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <vector>

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

}  // namespace
}  // namespace whisker::sim
