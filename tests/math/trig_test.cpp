#include "firmware/math/trig.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

namespace whisker {
namespace {

constexpr double kPi = 3.14159265358979323846;

bool long_run() { return std::getenv("WHISKER_LONG") != nullptr; }

double radians(Angle a) { return a.wrapped() * (kPi / 2147483648.0); }

struct Worst {
  double error = 0;
  double at = 0;
  void take(double e, double where) {
    if (std::abs(e) > error) {
      error = std::abs(e);
      at = where;
    }
  }
};

// Between two adjacent samples, sine and its approximation each change by less than the step. The
// approximation is one polynomial per quarter, so the sampled bound plus one step holds for every angle.
TEST(Sine, IsWithinItsStatedErrorOverAWholeTurn) {
  const std::uint32_t step = long_run() ? 1 : 61;
  Worst worst;
  for (std::uint64_t raw = 0; raw < (std::uint64_t{1} << 32); raw += step) {
    const Angle a = Angle::from_raw(static_cast<std::uint32_t>(raw));
    worst.take(sin(a).raw() / 1073741824.0 - std::sin(radians(a)), static_cast<double>(raw));
  }
  std::printf("sin: worst error %.3g at %.0f / 2^32 turn, every %u. angle\n", worst.error, worst.at, step);
  EXPECT_LE(worst.error, 6e-9);
}

TEST(Sine, IsExactAtQuartersAndOdd) {
  EXPECT_EQ(sin(Angle{}).raw(), 0);
  EXPECT_EQ(sin(Angle::turns(1, 4)).raw(), Q30::kOne);
  EXPECT_EQ(sin(Angle::turns(1, 2)).raw(), 0);
  EXPECT_EQ(sin(Angle::turns(3, 4)).raw(), -Q30::kOne);
  EXPECT_EQ(cos(Angle{}).raw(), Q30::kOne);
  EXPECT_EQ(cos(Angle::turns(1, 4)).raw(), 0);
  for (std::uint64_t raw = 0; raw < (std::uint64_t{1} << 32); raw += 9973) {
    const Angle a = Angle::from_raw(static_cast<std::uint32_t>(raw));
    ASSERT_EQ(sin(-a).raw(), -sin(a).raw()) << raw;
    ASSERT_EQ(cos(-a).raw(), cos(a).raw()) << raw;
  }
}

TEST(ArcTangent, IsWithinItsStatedErrorAtEveryMagnitude) {
  Worst worst;
  std::uint64_t state = 1;
  const auto random = [&state] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::uint32_t>(state >> 32);
  };
  const int count = long_run() ? 200000000 : 3000000;
  for (int i = 0; i < count; ++i) {
    // Operands of every magnitude: the rounding of the ratio is worst for medium ones.
    const auto draw = [&] {
      const std::uint32_t bits = random() % 32;
      const std::uint32_t value = random() >> bits;
      return static_cast<std::int32_t>(value);
    };
    const std::int32_t y = draw();
    const std::int32_t x = draw();
    if (x == 0 && y == 0) continue;
    const double exact = std::atan2(static_cast<double>(y), static_cast<double>(x));
    worst.take(std::remainder(radians(atan2(y, x)) - exact, 2 * kPi), exact);
  }
  std::printf("atan2: worst error %.3g rad near %.6f rad, %d points, seed 1\n", worst.error, worst.at, count);
  EXPECT_LE(worst.error, 1.2e-8);
}

TEST(ArcTangent, IsExactOnTheAxesAndDiagonalsAndOdd) {
  EXPECT_EQ(atan2(0, 0), Angle{});
  EXPECT_EQ(atan2(0, 5), Angle{});
  EXPECT_EQ(atan2(5, 0), Angle::turns(1, 4));
  EXPECT_EQ(atan2(0, -5), Angle::turns(1, 2));
  EXPECT_EQ(atan2(-5, 0), Angle::turns(3, 4));
  EXPECT_EQ(atan2(INT32_MIN, 0), Angle::turns(3, 4));
  EXPECT_EQ(atan2(0, INT32_MIN), Angle::turns(1, 2));
  for (std::int32_t y = -60; y <= 60; ++y) {
    for (std::int32_t x = -60; x <= 60; ++x) {
      if (y != 0) {
        ASSERT_EQ(atan2(-y, x), -atan2(y, x)) << y << ' ' << x;
      }
    }
  }
}

TEST(SquareRoot, IsTheFloorAroundEverySquare) {
  EXPECT_EQ(square_root(0), 0U);
  EXPECT_EQ(square_root(UINT64_MAX), UINT32_MAX);
  for (std::uint64_t r = 1; r <= UINT32_MAX; r += 1 + r / 1000) {
    ASSERT_EQ(square_root(r * r), r);
    ASSERT_EQ(square_root(r * r - 1), r - 1);
    ASSERT_EQ(square_root(r * r + 2 * r), r);
  }
}

TEST(SquareRoot, Of32BitsIsTheSame) {
  const bool all = long_run();
  for (std::uint64_t x = 0; x <= UINT32_MAX; x += all ? 1 : 1 + x / 50000) {
    const auto r = std::uint64_t{square_root_32(static_cast<std::uint32_t>(x))};
    ASSERT_TRUE(r * r <= x && x < (r + 1) * (r + 1)) << x;
  }
  for (std::uint32_t r = 1; r <= UINT16_MAX; ++r) {
    ASSERT_EQ(square_root_32(r * r), r);
    ASSERT_EQ(square_root_32(r * r - 1), r - 1);
  }
  EXPECT_EQ(square_root_32(UINT32_MAX), 65535U);
}

// Chips that divide slowly take it.
TEST(SquareRoot, WithoutADivisionIsTheSame) {
  const bool all = long_run();
  for (std::uint64_t x = std::uint64_t{1} << 30; x <= UINT32_MAX; x += all ? 1 : 997) {
    const formula::RootAndRest by_reciprocal = formula::root_and_rest<false>(static_cast<std::uint32_t>(x));
    const std::uint64_t r = by_reciprocal.root;
    ASSERT_TRUE(r * r <= x && x < (r + 1) * (r + 1)) << x;
    ASSERT_EQ(by_reciprocal.rest, x - r * r);
  }
  for (std::uint32_t r = (1U << 15) + 1; r <= UINT16_MAX; ++r) {
    ASSERT_EQ(formula::root_and_rest<false>(r * r).root, r);
    ASSERT_EQ(formula::root_and_rest<false>(r * r - 1).root, r - 1);
  }
}

TEST(SquareRoot, Of64BitsIsTheFloorAtEveryScale) {
  std::uint64_t state = 3;
  for (int i = 0; i < 2000000; ++i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    const auto r = static_cast<std::uint64_t>(state >> 32 >> i % 32);
    if (r == 0) continue;
    ASSERT_EQ(square_root(r * r), r);
    ASSERT_EQ(square_root(r * r - 1), r - 1);
    ASSERT_EQ(square_root(r * r + state % (2 * r + 1)), r);
  }
}

TEST(Vectors, FartherIsWhatTheNormSays) {
  for (int32_t x = -3000000; x <= 3000000; x += 77777) {
    for (const int32_t y : {-2500000, -1, 0, 3, 1234567}) {
      const Vec v{micrometres(x), micrometres(y)};
      const Length n = norm(v);
      ASSERT_FALSE(farther(v, n)) << x << ' ' << y;
      ASSERT_TRUE(farther(v, n - micrometres(1))) << x << ' ' << y;
    }
  }
  EXPECT_TRUE(farther({}, micrometres(-1)));
  EXPECT_FALSE(farther({}, Length{}));
}

TEST(Vectors, NormPolarAndAlongAgreeWithDoubles) {
  Worst norm_error;
  Worst polar_error;
  Worst along_error;
  std::uint64_t state = 7;
  for (int i = 0; i < 200000; ++i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    const std::int32_t x = static_cast<std::int32_t>(state >> 36) - (1 << 27);
    state = state * 6364136223846793005U + 1442695040888963407U;
    const std::int32_t y = static_cast<std::int32_t>(state >> 36) - (1 << 27);
    const Angle a = Angle::from_raw(static_cast<std::uint32_t>(state));
    const Vec v{micrometres(x), micrometres(y)};
    norm_error.take(norm(v).raw() - std::hypot(x, y), x);
    const Vec p = polar(a, micrometres(x));
    polar_error.take(std::hypot(p.x.raw() - x * std::cos(radians(a)), p.y.raw() - x * std::sin(radians(a))),
                     x);
    along_error.take(along(v, a).raw() - (x * std::cos(radians(a)) + y * std::sin(radians(a))), x);
  }
  std::printf("up to 134 m: norm %.2f um, polar %.2f um, along %.2f um, seed 7\n", norm_error.error,
              polar_error.error, along_error.error);
  EXPECT_LT(norm_error.error, 1.0);
  EXPECT_LT(polar_error.error, 1.6);
  EXPECT_LT(along_error.error, 2.2);
}

TEST(Vectors, SaturateAtTheEndOfTheWorld) {
  EXPECT_EQ(norm({Length::from_raw(INT32_MIN), Length::from_raw(INT32_MIN)}).raw(), INT32_MAX);
  EXPECT_EQ((Vec{Length::from_raw(INT32_MAX), {}} + Vec{Length::from_raw(1), {}}).x.raw(), INT32_MAX);
}

/// Compares compile-time and run-time results for these numbers.
template <std::int32_t kX, std::int32_t kY>
void expect_the_same_from_compiler_and_machine() {
  constexpr Angle kAngle =
      Angle::from_raw(static_cast<std::uint32_t>(kX) * 3U + static_cast<std::uint32_t>(kY));
  constexpr Vec kVec{micrometres(kX), micrometres(kY)};
  constexpr std::uint64_t kSquare = static_cast<std::uint64_t>(std::int64_t{kX} * kX);
  constexpr Q30 kSin = sin(kAngle);
  constexpr Q30 kCos = cos(kAngle);
  constexpr Angle kBearing = bearing(kVec);
  constexpr std::uint32_t kRoot = square_root(kSquare + 1);
  constexpr Length kNorm = norm(kVec);
  constexpr bool kFarther = farther(kVec, kNorm);
  constexpr Vec kPolar = polar(kAngle, kNorm);
  constexpr Length kAlong = along(kVec, kAngle);
  const Angle angle = kAngle;
  const Vec vec = kVec;
  EXPECT_EQ(at_run_time::sin(angle), kSin);
  EXPECT_EQ(cos(angle), kCos);
  EXPECT_EQ(at_run_time::atan2(vec.y.raw(), vec.x.raw()), kBearing);
  EXPECT_EQ(at_run_time::square_root(kSquare + 1), kRoot);
  EXPECT_EQ(at_run_time::norm(vec), kNorm);
  EXPECT_EQ(at_run_time::farther(vec, kNorm), kFarther);
  EXPECT_EQ(at_run_time::polar(angle, kNorm), kPolar);
  EXPECT_EQ(at_run_time::along(vec, facing(angle)), kAlong);
}

TEST(Trigonometry, IsTheSameInAConstantExpression) {
  expect_the_same_from_compiler_and_machine<0, 0>();
  expect_the_same_from_compiler_and_machine<1, -1>();
  expect_the_same_from_compiler_and_machine<-90000, 1234567>();
  expect_the_same_from_compiler_and_machine<2000000000, -1999999999>();
  expect_the_same_from_compiler_and_machine<INT32_MIN, INT32_MAX>();
  expect_the_same_from_compiler_and_machine<987654321, 123456789>();
}

}  // namespace
}  // namespace whisker
