#include "host/harness/sim/cone.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <functional>
#include <vector>

#include "tests/sim/generators.hpp"

namespace whisker::sim {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
const double kInfinity = std::numeric_limits<double>::infinity();

Cone cone_at(Vec2 apex, double axis, double half_width) {
  return {apex, {std::cos(axis), std::sin(axis)}, std::cos(half_width), std::sin(half_width)};
}

/// Distance from p along this direction to the disc; infinite for a miss.
double along_ray(Vec2 p, double direction, const Disc& disc) {
  const Vec2 u{std::cos(direction), std::sin(direction)};
  const Vec2 q = disc.center - p;
  if (std::hypot(q.x, q.y) <= disc.radius) return 0;
  const double root = disc.radius * disc.radius - dot(q, q) + dot(q, u) * dot(q, u);
  if (root < 0) return kInfinity;
  const double s = dot(q, u) - std::sqrt(root);
  return s >= 0 ? s : kInfinity;
}

double along_ray(Vec2 p, double direction, const Segment& s) {
  const Vec2 u{std::cos(direction), std::sin(direction)};
  const Vec2 d = s.b - s.a;
  const double slope = cross(u, d);
  if (slope == 0) return kInfinity;
  const double on_segment = cross(s.a - p, u) / slope;
  const double on_ray = cross(s.a - p, d) / slope;
  return on_segment >= 0 && on_segment <= 1 && on_ray >= 0 ? on_ray : kInfinity;
}

template <class Shape>
double by_rays(Vec2 apex, double axis, double half_width, const Shape& shape) {
  constexpr int kRays = 2000;
  double nearest = kInfinity;
  for (int i = 0; i <= kRays; ++i) {
    nearest = std::fmin(nearest, along_ray(apex, axis + half_width * (2.0 * i / kRays - 1), shape));
  }
  return nearest;
}

/// The nearest of many points of the shape that lie within the half width of the axis.
double by_points(Vec2 apex, double axis, double half_width, const std::function<Vec2(double)>& outline) {
  constexpr int kPoints = 4000;
  double nearest = kInfinity;
  for (int i = 0; i <= kPoints; ++i) {
    const Vec2 q = outline(double{1} * i / kPoints) - apex;
    const double off = std::fabs(std::remainder(std::atan2(q.y, q.x) - axis, 360 * kDegree));
    if (off <= half_width) nearest = std::fmin(nearest, std::hypot(q.x, q.y));
  }
  return nearest;
}

/// No ray may find a nearer point, and a slightly wider cone must contain a sample about as near: `gap` is
/// the largest distance from a point of the shape to the next sample.
template <class Shape>
void judge(const Shape& shape, const std::function<Vec2(double)>& outline, double gap) {
  const Vec2 apex = point(2);
  const double axis = real(-4, 4);
  const double half_width = real(0.5, 89) * kDegree;
  const double exact = range(cone_at(apex, axis, half_width), shape);
  RC_ASSERT(exact <= by_rays(apex, axis, half_width, shape) + 1e-9);
  RC_ASSERT(exact <= by_points(apex, axis, half_width - 1e-9, outline) + 1e-9);
  RC_CLASSIFY(exact < kInfinity, "in view");
  if (exact < kInfinity && exact > 2 * gap) {
    const double wider = half_width + std::asin(gap / exact) + 1e-9;
    RC_ASSERT(exact >= by_points(apex, axis, wider, outline) - gap - 1e-9);
  }
}

TEST(ConeRange, ToADiscAgreesWithDenseRaysAndPoints) {
  EXPECT_TRUE(rc::check([] {
    const Disc disc{point(3), real(0.01, 1.5)};
    judge(
        disc,
        [&](double t) {
          const double a = t * 360 * kDegree;
          return disc.center + Vec2{std::cos(a), std::sin(a)} * disc.radius;
        },
        disc.radius * 360 * kDegree / 4000);
  }));
}

TEST(ConeRange, ToASegmentAgreesWithDenseRaysAndPoints) {
  EXPECT_TRUE(rc::check([] {
    const Segment s{point(3), point(3)};
    judge(
        s, [&](double t) { return s.a + (s.b - s.a) * t; }, std::hypot(s.b.x - s.a.x, s.b.y - s.a.y) / 4000);
  }));
}

TEST(ConeRange, ToADiscAheadEndsAtItsNearRim) {
  EXPECT_DOUBLE_EQ(range(cone_at({0, 0}, 0, 10 * kDegree), Disc{{3, 0}, 1}), 2);
  EXPECT_DOUBLE_EQ(range(cone_at({0, 0}, 0, 10 * kDegree), Disc{{3, 0.2}, 1}), std::hypot(3, 0.2) - 1);
}

TEST(ConeRange, ToADiscBesideTheConeEndsOnTheConesEdge) {
  // The edge at 30 degrees runs along (cos, sin); the centre sits 2 m along it and 0.6 m outside.
  const double c = std::cos(30 * kDegree), s = std::sin(30 * kDegree);
  const Disc disc{{2 * c - 0.6 * s, 2 * s + 0.6 * c}, 1};
  EXPECT_NEAR(range(cone_at({0, 0}, 0, 30 * kDegree), disc), 2 - 0.8, 1e-14);
  const Disc mirrored{{disc.center.x, -disc.center.y}, 1};
  EXPECT_NEAR(range(cone_at({0, 0}, 0, 30 * kDegree), mirrored), 2 - 0.8, 1e-14);
}

TEST(ConeRange, ADiscWhoseCentreIsJustOutsideIsSeenAlongTheEdge) {
  const double c = std::cos(30 * kDegree), s = std::sin(30 * kDegree);
  const Disc disc{{c - 0.005 * s, s + 0.005 * c}, 0.02};
  EXPECT_NEAR(range(cone_at({0, 0}, 0, 30 * kDegree), disc), 1 - std::sqrt(0.02 * 0.02 - 0.005 * 0.005),
              1e-14);
}

TEST(ConeRange, AnEdgeThatIsTangentToADiscTouchesIt) {
  const double c = std::cos(30 * kDegree), s = std::sin(30 * kDegree);
  const auto beside = [&](double off) { return Disc{{2 * c - off * s, 2 * s + off * c}, 0.5}; };
  EXPECT_NEAR(range(cone_at({0, 0}, 0, 30 * kDegree), beside(0.5)), 2, 1e-6);
  EXPECT_EQ(range(cone_at({0, 0}, 0, 30 * kDegree), beside(0.5 + 1e-9)), kInfinity);
  EXPECT_LT(range(cone_at({0, 0}, 0, 30 * kDegree), beside(0.5 - 1e-9)), 2);
}

TEST(ConeRange, WhatIsBehindIsNotSeen) {
  for (const double half_width : {1.0, 12.5, 45.0, 89.0}) {
    const Cone cone = cone_at({0, 0}, 0, half_width * kDegree);
    EXPECT_EQ(range(cone, Disc{{-2, 0}, 1}), kInfinity);
    EXPECT_EQ(range(cone, Disc{{-2, 0.5}, 1.99}), kInfinity);
    EXPECT_EQ(range(cone, Segment{{-1, -5}, {-1, 5}}), kInfinity);
  }
}

TEST(ConeRange, TheApexInsideADiscSeesZeroWhereverItLooks) {
  for (int axis = 0; axis < 360; axis += 15) {
    EXPECT_EQ(range(cone_at({0.2, 0.1}, axis * kDegree, 5 * kDegree), Disc{{0, 0}, 0.5}), 0);
  }
}

TEST(ConeRange, ASegmentThroughTheApexIsAtZero) {
  for (int axis = 0; axis < 360; axis += 7) {
    for (int tilt = 0; tilt < 180; tilt += 11) {
      const Vec2 u{std::cos(tilt * kDegree), std::sin(tilt * kDegree)};
      const Vec2 apex{1.3, -0.7};
      EXPECT_NEAR(range(cone_at(apex, axis * kDegree, 12.5 * kDegree), Segment{apex - u, apex + u}), 0, 1e-11)
          << axis << ' ' << tilt;
    }
  }
}

TEST(ConeRange, AWallAcrossEndsAtItsFoot) {
  EXPECT_DOUBLE_EQ(range(cone_at({0, 0}, 0, 12.5 * kDegree), Segment{{2, -5}, {2, 5}}), 2);
}

TEST(ConeRange, AWallWhoseFootIsOutsideEndsOnTheEdge) {
  // The line y = 1 meets the 12.5 degree edge at 1 / sin 12.5.
  EXPECT_NEAR(range(cone_at({0, 0}, 0, 12.5 * kDegree), Segment{{-9, 1}, {9, 1}}),
              1 / std::sin(12.5 * kDegree), 1e-10);
}

TEST(ConeRange, ASegmentInsideTheConeMayEndAtItsEnd) {
  EXPECT_DOUBLE_EQ(range(cone_at({0, 0}, 0, 12.5 * kDegree), Segment{{1, 0.1}, {5, 0.2}}),
                   std::hypot(1, 0.1));
}

TEST(ConeRange, ASegmentThatLiesAlongTheAxisOrAnEdgeIsSeenAtItsNearEnd) {
  const double c = std::cos(20 * kDegree), s = std::sin(20 * kDegree);
  EXPECT_DOUBLE_EQ(range(cone_at({0, 0}, 0, 20 * kDegree), Segment{{1, 0}, {3, 0}}), 1);
  EXPECT_NEAR(range(cone_at({0, 0}, 0, 20 * kDegree), Segment{{c, s}, {3 * c, 3 * s}}), 1, 1e-9);
  EXPECT_NEAR(range(cone_at({0, 0}, 0, 20 * kDegree), Segment{{3 * c, -3 * s}, {c, -s}}), 1, 1e-9);
}

/// Angle between a ray in this direction from p and the normal where it first meets the shape.
double incidence(Vec2 p, double direction, const Disc& disc) {
  const Vec2 u{std::cos(direction), std::sin(direction)};
  return std::asin(std::fmin(1, std::fabs(cross(u, disc.center - p)) / disc.radius));
}
double incidence(Vec2, double direction, const Segment& s) {
  const Vec2 d = s.b - s.a;
  return std::asin(
      std::fmin(1, std::fabs(std::cos(direction) * d.x + std::sin(direction) * d.y) / std::hypot(d.x, d.y)));
}

/// The nearest of the rays that meet the shape at most this far from its normal.
template <class Shape>
double by_echoing_rays(Vec2 apex, double axis, double half_width, double most, const Shape& shape) {
  constexpr int kRays = 2000;
  double nearest = kInfinity;
  for (int i = 0; i <= kRays; ++i) {
    const double direction = axis + half_width * (2.0 * i / kRays - 1);
    if (incidence(apex, direction, shape) <= most)
      nearest = std::fmin(nearest, along_ray(apex, direction, shape));
  }
  return nearest;
}

/// With the limit, between what rays find at a slightly smaller and at a slightly larger one.
template <class Shape>
void judge_incidence(const Shape& shape, Vec2 apex) {
  const double axis = real(-4, 4);
  const double half_width = real(1, 60) * kDegree;
  const double most = real(10, 85) * kDegree;
  Cone cone = cone_at(apex, axis, half_width);
  const double every = range(cone, shape);
  RC_PRE(every > 0);
  cone.sin_incidence = std::sin(most);
  const double exact = range(cone, shape);
  RC_ASSERT(exact >= every - 1e-12);
  RC_ASSERT(exact <= by_echoing_rays(apex, axis, half_width, most - 1e-9, shape) + 1e-9);
  // The rays lie up to half_width / 1000 apart: so much more of the surface may be in view.
  const double step = half_width / 1000 + 1e-9;
  const double wider = by_echoing_rays(apex, axis, half_width + 2 * step, most + 4 * step + 1e-3, shape);
  RC_ASSERT(exact >= 0.95 * wider || exact <= kScatter);
  RC_CLASSIFY(exact < kInfinity, "echoes");
  RC_CLASSIFY(every < kInfinity && exact == kInfinity, "lost");
}

TEST(ConeRange, OfASlantedDiscAgreesWithTheRaysThatEcho) {
  EXPECT_TRUE(rc::check([] { judge_incidence(Disc{point(3), real(0.05, 1.5)}, point(3)); }));
}

TEST(ConeRange, OfASlantedSegmentAgreesWithTheRaysThatEcho) {
  EXPECT_TRUE(rc::check([] {
    const Segment s{point(3), point(3)};
    RC_PRE(std::hypot(s.b.x - s.a.x, s.b.y - s.a.y) > 0.1);
    judge_incidence(s, point(3));
  }));
}

TEST(ConeRange, AWallBeyondItsIncidenceIsLostButForItsEndsNearby) {
  Cone cone = cone_at({0, 0}, 0, 10 * kDegree);
  cone.sin_incidence = std::sin(40 * kDegree);
  const auto wall = [](double far, double degrees, double from, double to) {
    const Vec2 along{std::sin(degrees * kDegree), std::cos(degrees * kDegree)};
    return Segment{Vec2{far, 0} + along * from, Vec2{far, 0} + along * to};
  };
  // The edge of the cone is 10 degrees nearer to the normal than the axis.
  EXPECT_LT(range(cone, wall(1, 49, -5, 5)), 1);
  EXPECT_EQ(range(cone, wall(1, 51, -5, 5)), kInfinity);
  EXPECT_EQ(range(cone, wall(0.4, 51, -5, 5)), kInfinity);
  EXPECT_DOUBLE_EQ(range(cone, wall(0.4, 51, 0, 5)), 0.4);
  EXPECT_EQ(range(cone, wall(0.6, 51, 0, 5)), kInfinity);
  EXPECT_LT(range(cone, wall(0.4, 51, 0, -5)), kInfinity);
}

TEST(ConeRange, OfAWorldIsTheNearestOfItsParts) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Disc> discs;
    std::vector<Segment> segments;
    const std::size_t n = *rc::gen::inRange<std::size_t>(0, 6);
    for (std::size_t i = 0; i < n; ++i) {
      discs.push_back({point(3), real(0.01, 0.5)});
      segments.push_back({point(3), point(3)});
    }
    const std::vector<Vec2> path{point(3), point(3), point(3)};
    const MovingDisc mover{path.data(), path.size(), real(0.01, 0.5), real(0, 1), 0};
    const double t = real(0, 20);
    const Cone cone = cone_at(point(1), real(-4, 4), real(1, 60) * kDegree);
    const WorldView world{discs.data(), n, segments.data(), n, &mover, 1};

    double expected = range(cone, Disc{position(mover, t), mover.radius});
    for (const Disc& d : discs) expected = std::fmin(expected, range(cone, d));
    for (const Segment& s : segments) expected = std::fmin(expected, range(cone, s));
    const double limit = real(0.1, 4);
    const double got = range(cone, world, t, limit);
    if (expected < limit) {
      RC_ASSERT(std::fabs(got - expected) < 1e-12);
    } else {
      RC_ASSERT(got == kInfinity);
    }
  }));
}

}  // namespace
}  // namespace whisker::sim
