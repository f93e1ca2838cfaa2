#include "host/harness/sim/tapered_cone.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "tests/sim/generators.hpp"

namespace whisker::sim {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
const double kInfinity = std::numeric_limits<double>::infinity();

Cone plain(Vec2 apex, double axis) { return {apex, {std::cos(axis), std::sin(axis)}, 1, 0}; }

TaperedCone ahead(double near_deg, double far_deg, double reach) {
  return {plain({0, 0}, 0), near_deg * kDegree, far_deg * kDegree, reach};
}

/// Samples of an outline, and the largest distance from a point of it to the next sample.
struct Outline {
  std::function<Vec2(double)> at;
  double gap;
};
constexpr int kPoints = 4000;

Outline outline(const Disc& d) {
  return {[=](double t) {
            const double a = t * 360 * kDegree;
            return d.center + Vec2{std::cos(a), std::sin(a)} * d.radius;
          },
          d.radius * 360 * kDegree / kPoints};
}
Outline outline(const Segment& s) {
  return {[=](double t) { return s.a + (s.b - s.a) * t; },
          std::hypot(s.b.x - s.a.x, s.b.y - s.a.y) / kPoints};
}

/// The nearest sample within a cone that is wider by `slack` and by what `gap` spans, and longer by `gap`;
/// of those that `echoes` accepts.
double by_points(
    const Outline& shape, Vec2 apex, double axis, const TaperedCone& cone, double slack, double gap,
    const std::function<bool(Vec2)>& echoes = [](Vec2) { return true; }) {
  double nearest = kInfinity;
  for (int i = 0; i <= kPoints; ++i) {
    const Vec2 q = shape.at(double{1} * i / kPoints) - apex;
    const double d = std::hypot(q.x, q.y);
    const double off = std::fabs(std::remainder(std::atan2(q.y, q.x) - axis, 360 * kDegree));
    const double share = std::fmin(1, std::fmax(0, d - gap) / cone.reach);
    const double half_width = cone.near + (cone.far - cone.near) * share;
    const double spans = gap > 0 ? std::asin(std::fmin(1, gap / std::fmax(d, 1e-9))) : 0;
    if (off <= half_width + slack + spans && echoes(q)) nearest = std::fmin(nearest, d);
  }
  return nearest;
}

template <class Shape>
void judge(const Shape& shape, const WorldView& world) {
  const Vec2 apex = point(3);
  const double axis = real(-4, 4);
  const double near = real(5, 80) * kDegree;
  const TaperedCone cone(plain(apex, axis), near, near * real(0.05, 1), real(0.5, 6));
  const double exact = range(cone, world, 0, kInfinity);
  const Outline points = outline(shape);
  RC_ASSERT(exact <= by_points(points, apex, axis, cone, -1e-9, 0) + 1e-9);
  RC_CLASSIFY(exact < kInfinity, "in view");
  RC_CLASSIFY(exact > range(cone.widest, world, 0, kInfinity), "the taper matters");
  const double slack = (cone.near - cone.far) * kTaperSlack + 1e-9;
  if (exact < kInfinity && exact > 2 * points.gap) {
    RC_ASSERT(exact >= by_points(points, apex, axis, cone, slack, points.gap) - points.gap - 1e-9);
  }
}

TEST(TaperedCone, ToADiscAgreesWithDensePoints) {
  EXPECT_TRUE(rc::check([] {
    const Disc disc{point(3), real(0.01, 1)};
    const WorldView world{&disc, 1, nullptr, 0, nullptr, 0};
    judge(disc, world);
  }));
}

TEST(TaperedCone, ToADiscThatIsSlantedAgreesWithThePointsThatEcho) {
  EXPECT_TRUE(rc::check([] {
    const Disc disc{point(3), real(0.1, 1)};
    const WorldView world{&disc, 1, nullptr, 0, nullptr, 0};
    const Vec2 apex = point(3);
    const double axis = real(-4, 4);
    const double near = real(5, 80) * kDegree;
    const double most = real(10, 80) * kDegree;
    Cone front = plain(apex, axis);
    front.sin_incidence = std::sin(most);
    const TaperedCone cone(front, near, near * real(0.05, 1), real(0.5, 6));
    const double exact = range(cone, world, 0, kInfinity);
    RC_PRE(exact > 0);
    const Outline points = outline(disc);
    const auto up_to = [&](double limit) {
      return [=](Vec2 q) {
        const Vec2 normal = (q + apex - disc.center) * (1 / disc.radius);
        return -dot(q, normal) >= std::cos(limit) * std::hypot(q.x, q.y);
      };
    };
    RC_ASSERT(exact <= by_points(points, apex, axis, cone, -1e-9, 0, up_to(most - 1e-9)) + 1e-9);
    RC_CLASSIFY(exact < kInfinity, "echoes");
    if (exact < kInfinity && exact > 2 * points.gap) {
      const double slack = (cone.near - cone.far) * kTaperSlack + 1e-9;
      const double more = most + points.gap / disc.radius + 2 * points.gap / exact;
      RC_ASSERT(exact >=
                by_points(points, apex, axis, cone, slack, points.gap, up_to(more)) - points.gap - 1e-9);
    }
  }));
}

TEST(TaperedCone, ToASegmentAgreesWithDensePoints) {
  EXPECT_TRUE(rc::check([] {
    const Segment s{point(3), point(3)};
    const WorldView world{nullptr, 0, &s, 1, nullptr, 0};
    judge(s, world);
  }));
}

TEST(TaperedCone, SeesBesideTheAxisWhatIsNearOnly) {
  const TaperedCone cone = ahead(20, 5, 4);
  const auto post = [&](double d, double degrees) {
    const Segment s{{d * std::cos(degrees * kDegree), d * std::sin(degrees * kDegree)},
                    {d * std::cos(degrees * kDegree), d * std::sin(degrees * kDegree)}};
    return range(cone, {nullptr, 0, &s, 1, nullptr, 0}, 0, kInfinity);
  };
  // The half width is 20 - 15 d / 4 degrees.
  EXPECT_NEAR(post(1, 16.2), 1, 1e-12);
  EXPECT_EQ(post(1, 16.3), kInfinity);
  EXPECT_NEAR(post(2, -12.4), 2, 1e-12);
  EXPECT_EQ(post(2, -12.6), kInfinity);
  EXPECT_NEAR(post(9, 4.9), 9, 1e-11);
  EXPECT_EQ(post(9, 5.1), kInfinity);
}

TEST(TaperedCone, FindsTheFartherOfTwoIfTheNearerIsOutside) {
  const Disc discs[] = {{{2, 1.2}, 0.3}, {{3, 0}, 0.2}};
  const WorldView world{discs, 2, nullptr, 0, nullptr, 0};
  EXPECT_LT(range(ahead(30, 30, 4), world, 0, kInfinity), 2.3);
  EXPECT_NEAR(range(ahead(30, 5, 4), world, 0, kInfinity), 2.8, 1e-12);
}

TEST(TaperedCone, WithoutATaperIsThePlainCone) {
  EXPECT_TRUE(rc::check([] {
    const Disc disc{point(3), real(0.01, 1)};
    const WorldView world{&disc, 1, nullptr, 0, nullptr, 0};
    const double half = real(1, 80) * kDegree;
    const TaperedCone cone(plain(point(3), real(-4, 4)), half, half, 2);
    const double limit = real(0.1, 5);
    RC_ASSERT(range(cone, world, 0, limit) == range(cone.widest, world, 0, limit));
  }));
}

TEST(SoftObstacles, GiveAnEchoOnlyNearby) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Disc> discs;
    std::vector<Segment> segments;
    const std::size_t n = *rc::gen::inRange<std::size_t>(1, 5);
    std::vector<std::uint8_t> soft;
    for (std::size_t i = 0; i < n; ++i) {
      discs.push_back({point(3), real(0.01, 0.5)});
      segments.push_back({point(3), point(3)});
    }
    const Vec2 stands = point(3);
    const MovingDisc mover{&stands, 1, real(0.01, 0.5), 0, 0};
    for (std::size_t i = 0; i < 2 * n + 1; ++i) soft.push_back(*rc::gen::inRange<std::uint8_t>(0, 2));
    const WorldView world{discs.data(), n, segments.data(), n, &mover, 1, soft.data()};
    Cone cone = plain(point(1), real(-4, 4));
    const double half = real(1, 80) * kDegree;
    cone.cos_half = std::cos(half);
    cone.sin_half = std::sin(half);
    const double most = real(0.1, 4);

    double expected = kInfinity;
    const auto add = [&](std::size_t place, double d) {
      if (soft[place] == 0 || d < most) expected = std::fmin(expected, d);
    };
    for (std::size_t i = 0; i < n; ++i) add(i, range(cone, discs[i]));
    add(n, range(cone, Disc{stands, mover.radius}));
    for (std::size_t i = 0; i < n; ++i) add(n + 1 + i, range(cone, segments[i]));
    const double got = range(cone, world, 0, 5, most);
    RC_ASSERT((expected < 5 ? std::fabs(got - expected) < 1e-12 : got == kInfinity));
  }));
}

TEST(CornerScatter, ReachesAsFarAsTheConeSays) {
  Cone cone = plain({0, 0}, 0);
  cone.cos_half = std::cos(10 * kDegree);
  cone.sin_half = std::sin(10 * kDegree);
  cone.sin_incidence = std::sin(40 * kDegree);
  const Segment slanted{{0.8, 0}, {4, 3}};
  EXPECT_EQ(range(cone, slanted), kInfinity) << "beyond the usual 0.5 m";
  cone.scatter = 0.81;
  EXPECT_DOUBLE_EQ(range(cone, slanted), 0.8);
  cone.scatter = 0;
  EXPECT_EQ(range(cone, Segment{{0.1, 0}, {4, 3}}), kInfinity);
}

}  // namespace
}  // namespace whisker::sim
