#include "host/paths/tangent.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/scenario/shapes.hpp"
#include "host/worlds/random.hpp"

namespace whisker::paths {
namespace {

using sim::Vec2;

constexpr Side kSides[] = {Side::left, Side::right};

/// Signed distance of the centre to the left of the directed line.
double left_of(const sim::Segment& line, Vec2 centre) {
  return sim::cross((line.b - line.a) * (1 / distance(line.a, line.b)), centre - line.a);
}

TEST(Tangent, TouchesBothDiscsOnTheSidesAskedFor) {
  worlds::Random random(7);
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const sim::Disc a{{random.uniform(-1, 1), random.uniform(-1, 1)}, random.uniform(0, 1)};
    const sim::Disc b{{random.uniform(-1, 1), random.uniform(-1, 1)},
                      random.chance(0.1) ? 0 : random.uniform(0, 1)};
    const double d = distance(a.center, b.center);
    for (const Side side_a : kSides) {
      for (const Side side_b : kSides) {
        const auto t = tangent(a, side_a, b, side_b);
        const double least = side_a == side_b ? std::fabs(a.radius - b.radius) : a.radius + b.radius;
        ASSERT_EQ(t.has_value(), d > least) << i;
        if (!t || t->length_m < 1e-3) continue;
        ++found;
        EXPECT_NEAR(distance(t->line.a, t->line.b), t->length_m, 1e-12);
        EXPECT_NEAR(distance(t->line.a, a.center), a.radius, 1e-12);
        EXPECT_NEAR(distance(t->line.b, b.center), b.radius, 1e-12);
        EXPECT_NEAR(left_of(t->line, a.center), a.radius * static_cast<int>(side_a), 1e-9);
        EXPECT_NEAR(left_of(t->line, b.center), b.radius * static_cast<int>(side_b), 1e-9);
      }
    }
  }
  EXPECT_GT(found, 3000);
}

TEST(Tangent, APointOnTheRimHasOneOfNoLength) {
  const sim::Disc disc{{0, 0}, 0.5};
  for (const double radius : {0.5, 0.5 - 1e-12, 0.5 + 1e-12}) {
    const auto t = tangent({{0, radius}, 0}, Side::left, disc, Side::right);
    ASSERT_TRUE(t);
    EXPECT_LT(t->length_m, 2e-6);
    EXPECT_NEAR(t->normal.y, 1, 1e-5);
  }
}

}  // namespace
}  // namespace whisker::paths
