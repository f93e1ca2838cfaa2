#include "host/harness/sim/elementary.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "host/harness/sim/distance.hpp"
#include "host/harness/sim/random.hpp"
#include "tests/sim/generators.hpp"

namespace whisker::sim {
namespace {

/// The largest error over random and evenly spaced arguments; the reference computes in long double.
template <class Error>
double largest_error(double low, double high, Error error) {
  std::mt19937_64 random(20240601);
  std::uniform_real_distribution<double> anywhere(low, high);
  constexpr int kCount = 400000;
  double worst = 0;
  for (int i = 0; i <= kCount; ++i) {
    worst = std::fmax(worst, error(low + (high - low) * i / kCount));
    worst = std::fmax(worst, error(anywhere(random)));
  }
  return worst;
}

double relative(double x, long double exact) {
  return static_cast<double>(std::fabs((static_cast<long double>(x) - exact) / exact));
}

double absolute(double x, long double exact) {
  return static_cast<double>(std::fabs(static_cast<long double>(x) - exact));
}

TEST(Elementary, SineAndCosineAreRightFarFromZeroToo) {
  const auto error = [](double x) {
    const SinCos sc = sin_cos(x);
    return std::fmax(absolute(sc.sin, std::sin(static_cast<long double>(x))),
                     absolute(sc.cos, std::cos(static_cast<long double>(x))));
  };
  const double near = largest_error(-10, 10, error);
  const double far = largest_error(-1e6, 1e6, error);
  RecordProperty("near", std::to_string(near * 1e16));
  RecordProperty("far", std::to_string(far * 1e16));
  EXPECT_LT(near, 2e-16);
  EXPECT_LT(far, 2e-16);
}

TEST(Elementary, QuarterTurnsAgreeWithTheLibrary) {
  for (int k = -8; k <= 8; ++k) {
    const SinCos sc = sin_cos(k * (kPi / 2));
    EXPECT_NEAR(sc.sin, std::sin(k * (kPi / 2)), 1.2e-16) << k;
    EXPECT_NEAR(sc.cos, std::cos(k * (kPi / 2)), 1.2e-16) << k;
  }
  EXPECT_EQ(sin_cos(0).sin, 0.0);
  EXPECT_EQ(sin_cos(0).cos, 1.0);
}

TEST(Elementary, ArcTangentIsRightAllAroundTheCircle) {
  const double worst = largest_error(-3.14159, 3.14159, [](double angle) {
    const double x = 3.7 * std::cos(angle);
    const double y = 3.7 * std::sin(angle);
    const long double exact = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
    return y == 0 ? 0.0 : relative(arc_tangent(y, x), exact);
  });
  RecordProperty("worst", std::to_string(worst * 1e16));
  EXPECT_LT(worst, 4e-16);
}

TEST(Elementary, ArcTangentIsRightOnTheAxes) {
  EXPECT_EQ(arc_tangent(0, 0), 0.0);
  EXPECT_EQ(arc_tangent(0, 2), 0.0);
  EXPECT_EQ(arc_tangent(0, -2), kPi);
  EXPECT_EQ(arc_tangent(2, 0), kPi / 2);
  EXPECT_EQ(arc_tangent(-2, 0), -kPi / 2);
  EXPECT_EQ(arc_tangent(1, 1), kPi / 4);
  EXPECT_EQ(arc_tangent(-1, -1), -(kPi - kPi / 4));
}

TEST(Elementary, LogarithmIsRightFromTheSmallestToTheLargest) {
  const auto error = [](double x) {
    return x == 1 ? 0.0 : relative(natural_log(x), std::log(static_cast<long double>(x)));
  };
  double worst = largest_error(1e-9, 1, error);
  worst = std::fmax(worst, largest_error(0.99, 1.01, error));
  worst = std::fmax(worst, largest_error(1, 1e6, error));
  for (int e = -1022; e <= 1023; ++e) worst = std::fmax(worst, error(std::ldexp(1.37, e)));
  RecordProperty("worst", std::to_string(worst * 1e16));
  EXPECT_LT(worst, 2e-16);
  EXPECT_EQ(natural_log(1), 0.0);
}

TEST(Elementary, ExponentialIsRightAndVanishesFarBelowZero) {
  const auto error = [](double x) { return relative(exponential(x), std::exp(static_cast<long double>(x))); };
  double worst = largest_error(-700, 700, error);
  worst = std::fmax(worst, largest_error(-1, 1, error));
  RecordProperty("worst", std::to_string(worst * 1e16));
  EXPECT_LT(worst, 2e-16);
  EXPECT_EQ(exponential(0), 1.0);
  EXPECT_EQ(exponential(-701), 0.0);
}

TEST(Elementary, WholeBelowAgreesWithFloor) {
  for (const double x : {0.0, -0.0, 0.5, -0.5, 1.0, -1.0, -1.5, 1e15 + 0.5, -1e15 - 0.5, 4e18, -4e18}) {
    EXPECT_EQ(whole_below(x), static_cast<int64_t>(std::floor(x))) << x;
  }
  EXPECT_EQ(
      largest_error(-1e7, 1e7, [](double x) { return static_cast<double>(whole_below(x)) - std::floor(x); }),
      0.0);
}

TEST(Distance, ToADiscIsNegativeInside) {
  const Disc disc{{1, 2}, 0.5};
  EXPECT_DOUBLE_EQ(signed_distance({1, 2}, disc), -0.5);
  EXPECT_DOUBLE_EQ(signed_distance({4, 6}, disc), 4.5);
  EXPECT_DOUBLE_EQ(signed_distance({1.5, 2}, disc), 0);
}

TEST(Distance, ToASegmentMeetsItsInsideOrItsEnds) {
  const Segment s{{0, 0}, {4, 0}};
  EXPECT_DOUBLE_EQ(distance({2, 3}, s), 3);
  EXPECT_DOUBLE_EQ(distance({-3, 4}, s), 5);
  EXPECT_DOUBLE_EQ(distance({7, -4}, s), 5);
  EXPECT_DOUBLE_EQ(distance({1, 0}, s), 0);
}

TEST(Distance, ToASegmentOfNoLengthIsToItsPoint) { EXPECT_DOUBLE_EQ(distance({3, 4}, {{0, 0}, {0, 0}}), 5); }

TEST(Distance, ToASegmentAgreesWithATernarySearchAlongIt) {
  EXPECT_TRUE(rc::check([] {
    const Vec2 p = point(3);
    const Segment s{point(3), point(3)};
    // The distance is convex along the segment.
    const auto at = [&](double t) {
      return std::hypot(p.x - s.a.x - t * (s.b.x - s.a.x), p.y - s.a.y - t * (s.b.y - s.a.y));
    };
    double low = 0, high = 1;
    for (int i = 0; i < 100; ++i) {
      const double m1 = low + (high - low) / 3, m2 = high - (high - low) / 3;
      (at(m1) < at(m2) ? high : low) = at(m1) < at(m2) ? m2 : m1;
    }
    // Near the minimum, the search cannot resolve steps below the square root of the precision.
    RC_ASSERT(std::fabs(distance(p, s) - at(0.5 * (low + high))) < 1e-7);
  }));
}

TEST(Contains, ASquareHoldsItsMiddleAndNotItsOutside) {
  for (const bool clockwise : {false, true}) {
    std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    if (clockwise) square = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    EXPECT_TRUE(contains(square.data(), 4, {0.5, 0.5}));
    EXPECT_TRUE(contains(square.data(), 4, {0.001, 0.999}));
    for (const Vec2 out : {Vec2{1.5, 0.5}, Vec2{-0.5, 0.5}, Vec2{0.5, 1.5}, Vec2{0.5, -0.5}, Vec2{-1, 1}}) {
      EXPECT_FALSE(contains(square.data(), 4, out)) << out.x << ' ' << out.y;
    }
  }
}

TEST(Contains, ANotchIsOutside) {
  const std::vector<Vec2> notched{{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  EXPECT_FALSE(contains(notched.data(), notched.size(), {2, 2}));
  EXPECT_TRUE(contains(notched.data(), notched.size(), {2, 0.5}));
  EXPECT_TRUE(contains(notched.data(), notched.size(), {0.5, 2}));
  EXPECT_TRUE(contains(notched.data(), notched.size(), {3.5, 2}));
}

TEST(Contains, AgreesWithTheWindingAngle) {
  EXPECT_TRUE(rc::check([] {
    // Star-shaped around the origin: any radii at increasing angles.
    const int n = *rc::gen::inRange(3, 12);
    std::vector<Vec2> polygon;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * 3.14159265358979 * i / n, radius = real(0.2, 2);
      polygon.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    const Vec2 p = point(2.5);
    double turned = 0, nearest = 1e9;
    for (int i = 0; i < n; ++i) {
      const Vec2 a = polygon[static_cast<std::size_t>(i)] - p;
      const Vec2 b = polygon[static_cast<std::size_t>((i + 1) % n)] - p;
      turned += std::atan2(cross(a, b), dot(a, b));
      nearest = std::fmin(nearest, distance({0, 0}, {a, b}));
    }
    RC_PRE(nearest > 1e-9);
    RC_ASSERT(contains(polygon.data(), polygon.size(), p) == (std::fabs(turned) > 1));
  }));
}

constexpr std::uint64_t kSeed = 12345;
constexpr int kCount = 1000000;

/// The largest distance between the sample's and the true distribution function, times the square root of the
/// count: it exceeds 1.95 for one in a thousand seeds (Kolmogorov).
template <class Cdf>
double kolmogorov(std::vector<double> sample, Cdf cdf) {
  std::sort(sample.begin(), sample.end());
  const double n = static_cast<double>(sample.size());
  double worst = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double f = cdf(sample[i]);
    const double below = static_cast<double>(i) / n;
    worst = std::max({worst, std::fabs(f - below), std::fabs(f - below - 1 / n)});
  }
  return worst * std::sqrt(n);
}

TEST(Random, GivesThePublishedNumbersOfXoshiro256PlusPlus) {
  Random random(Random::State{{1, 2, 3, 4}});
  for (const std::uint64_t expected :
       {UINT64_C(41943041), UINT64_C(58720359), UINT64_C(3588806011781223), UINT64_C(3591011842654386),
        UINT64_C(9228616714210784205), UINT64_C(9973669472204895162)}) {
    EXPECT_EQ(random.next(), expected);
  }
}

TEST(Random, UniformNumbersAreUniform) {
  Random random(kSeed, 0);
  std::vector<double> sample;
  for (int i = 0; i < kCount; ++i) {
    sample.push_back(random.uniform());
    ASSERT_TRUE(sample.back() >= 0 && sample.back() < 1) << "seed " << kSeed << " at " << i;
  }
  EXPECT_LT(kolmogorov(sample, [](double x) { return x; }), 1.95) << "seed " << kSeed;
}

TEST(Random, NormalNumbersAreNormal) {
  Random random(kSeed, 1);
  std::vector<double> sample;
  double fourth = 0;
  for (int i = 0; i < kCount; ++i) {
    sample.push_back(random.normal());
    fourth += std::pow(sample.back(), 4) / kCount;
  }
  EXPECT_LT(kolmogorov(sample, [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }), 1.95)
      << "seed " << kSeed;
  // The standard deviation of the fourth power is the square root of 96.
  EXPECT_NEAR(fourth, 3.0, 4 * std::sqrt(96.0 / kCount)) << "seed " << kSeed;
}

TEST(Random, SuccessiveNormalNumbersAreUncorrelated) {
  Random random(kSeed, 2);
  double sum = 0;
  double before = random.normal();
  for (int i = 0; i < kCount; ++i) {
    const double now = random.normal();
    sum += before * now;
    before = now;
  }
  EXPECT_NEAR(sum / kCount, 0, 4 / std::sqrt(double{kCount})) << "seed " << kSeed;
}

TEST(Random, StreamsAndSeedsAreUncorrelated) {
  const auto correlation = [](Random a, Random b) {
    double sum = 0;
    for (int i = 0; i < kCount; ++i) sum += (a.uniform() - 0.5) * (b.uniform() - 0.5);
    return sum / kCount;
  };
  const double bound = 4 / 12.0 / std::sqrt(double{kCount});
  for (std::uint32_t stream = 1; stream < 8; ++stream) {
    EXPECT_NEAR(correlation({kSeed, 0}, {kSeed, stream}), 0, bound) << "stream " << stream;
    EXPECT_NEAR(correlation({kSeed, 0}, {kSeed + stream, 0}), 0, bound) << "seed " << kSeed + stream;
  }
}

TEST(Random, NeighbouringSeedsAndStreamsNeverMeet) {
  // If the stream were added to the seed, (s, 1) would equal (s + 1, 0).
  std::vector<std::uint64_t> firsts;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    for (std::uint32_t stream = 0; stream < 64; ++stream) firsts.push_back(Random(seed, stream).next());
  }
  std::sort(firsts.begin(), firsts.end());
  EXPECT_EQ(std::adjacent_find(firsts.begin(), firsts.end()), firsts.end());
}

TEST(Random, ANormalNumberAlwaysTakesTwoOfTheStream) {
  Random a(kSeed, 3);
  Random b(kSeed, 3);
  for (int i = 0; i < 10000; ++i) {
    a.normal();
    b.next();
    b.next();
    ASSERT_EQ(Random(a).next(), Random(b).next()) << i;
  }
}

}  // namespace
}  // namespace whisker::sim
