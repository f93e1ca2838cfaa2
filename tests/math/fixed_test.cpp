#include "firmware/math/fixed.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "firmware/math/angle.hpp"
#include "firmware/math/quotient.hpp"
#include "firmware/math/units.hpp"
#include "tests/effort.hpp"

namespace whisker {
namespace {

using namespace literals;

TEST(Fixed, RoundsEveryQ15ProductToNearestTiesAwayFromZero) {
  for (std::int32_t a = INT16_MIN; a <= INT16_MAX; a += 7) {
    for (std::int32_t b = INT16_MIN; b <= INT16_MAX; b += 251) {
      const std::int32_t product = a * b;
      const std::int32_t size = product < 0 ? -product : product;
      std::int32_t expected = (size + 16384) / 32768;
      if (product < 0) expected = -expected;
      if (expected > INT16_MAX) expected = INT16_MAX;
      const Q15 got =
          Q15::from_raw(static_cast<std::int16_t>(a)) * Q15::from_raw(static_cast<std::int16_t>(b));
      ASSERT_EQ(got.raw(), expected) << a << " * " << b;
    }
  }
}

TEST(Fixed, ScaleDownIsOddAndTiesGoAwayFromZero) {
  for (std::int32_t x = -4000; x <= 4000; ++x) {
    ASSERT_EQ(scale_down<4>(-x), -scale_down<4>(x)) << x;
    ASSERT_EQ(scale_down<4>(std::int64_t{x}), scale_down<4>(x)) << x;
    ASSERT_LE(magnitude(std::int64_t{scale_down<4>(x)} * 16 - x), 8U) << x;
  }
  EXPECT_EQ(scale_down<4>(8), 1);
  EXPECT_EQ(scale_down<4>(-8), -1);
  EXPECT_EQ(scale_down<4>(7), 0);
}

TEST(Fixed, RatioRoundsAndSaturates) {
  EXPECT_EQ(Q14::ratio(1, 3).raw(), 5461);
  EXPECT_EQ(Q14::ratio(-1, 3).raw(), -5461);
  EXPECT_EQ(Q14::ratio(2, 1).raw(), INT16_MAX);
  EXPECT_EQ(Q14::ratio(-2, 1).raw(), INT16_MIN);
  EXPECT_EQ((-Q14::from_raw(INT16_MIN)).raw(), INT16_MAX);
  EXPECT_EQ((Q7::from_raw(30000) + Q7::from_raw(30000)).raw(), INT16_MAX);
  EXPECT_EQ((Q7::from_raw(-30000) - Q7::from_raw(30000)).raw(), INT16_MIN);
}

TEST(Fixed, SumsSaturateAtBothEnds) {
  EXPECT_EQ(saturating_add(INT32_MAX, 1), INT32_MAX);
  EXPECT_EQ(saturating_add(INT32_MIN, -1), INT32_MIN);
  EXPECT_EQ(saturating_subtract(INT32_MIN, 1), INT32_MIN);
  EXPECT_EQ(saturating_subtract(INT32_MAX, -1), INT32_MAX);
  EXPECT_EQ(saturating_subtract(0, INT32_MIN), INT32_MAX);
  EXPECT_EQ(saturating_negate(INT32_MIN), INT32_MAX);
  EXPECT_EQ(saturate32(INT64_MIN), INT32_MIN);
  EXPECT_EQ(saturate16(40000), INT16_MAX);
  EXPECT_EQ(saturate16(-40000), INT16_MIN);
  EXPECT_EQ(magnitude(INT32_MIN), 2147483648U);
  EXPECT_EQ(magnitude(INT64_MIN), 9223372036854775808U);
}

TEST(Units, ProductsHaveTheRightUnitAndSaturate) {
  EXPECT_EQ((300_mm_per_s * 10_ms).raw(), 3000);
  EXPECT_EQ((1000_mm_per_s2 * 10_ms).raw(), 10000);
  EXPECT_EQ((3000_mrad_per_s * 70_mm), 210_mm_per_s);
  EXPECT_EQ((200_mm * Q14::ratio(17, 10)).raw(), 340002);
  EXPECT_EQ((2000_m * 2).raw(), INT32_MAX);
  EXPECT_EQ((-(2000_m) * 2).raw(), INT32_MIN);
  EXPECT_EQ(5_mm / 2, micrometres(2500));
  EXPECT_EQ(limit(5_mm, 3_mm), 3_mm);
  EXPECT_EQ(limit(-(5_mm), 3_mm), -(3_mm));
  EXPECT_EQ(abs(Length::from_raw(INT32_MIN)).raw(), INT32_MAX);
}

TEST(Units, MillimetresSaturate) {
  EXPECT_EQ(millimetres(-7), micrometres(-7000));
  EXPECT_EQ(millimetres(2'147'483), micrometres(2'147'483'000));
  EXPECT_EQ(millimetres(2'147'484), micrometres(INT32_MAX));
  EXPECT_EQ(millimetres(-2'147'483), micrometres(-2'147'483'000));
  EXPECT_EQ(millimetres(-2'147'484), micrometres(INT32_MIN));
}

TEST(Units, TimeWrapsAndDifferencesSurviveIt) {
  for (const std::uint32_t start : {0U, 5U, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFBU}) {
    for (const std::int32_t gap : {0, 1, 10, -1, -10, INT32_MAX, INT32_MIN}) {
      const Time a = Time::from_raw(start);
      EXPECT_EQ(((a + milliseconds(gap)) - a).raw(), gap) << start;
    }
  }
  EXPECT_EQ((Time::from_raw(3) - 5_ms).raw(), 0xFFFFFFFEU);
}

TEST(Angles, WrapAndScale) {
  EXPECT_EQ((90_deg).raw(), 0x40000000U);
  EXPECT_EQ(270_deg + 180_deg, 90_deg);
  EXPECT_EQ(magnitude(350_deg), (10_deg).raw());
  EXPECT_EQ(magnitude(180_deg), 0x80000000U);
  EXPECT_EQ((10_deg * -3), -(30_deg));
  EXPECT_EQ(scaled(30_deg, Q14::ratio(-3, 2)).wrapped(), -(45_deg).wrapped());
  EXPECT_EQ(arc(180_deg - Angle::from_raw(1), 70_mm), micrometres(219911));
  EXPECT_EQ(arc(-(90_deg), 70_mm), micrometres(-109956));
  EXPECT_EQ(Angle::turns(-1, 4), 270_deg);
}

constexpr std::uint64_t kLargest32 = UINT32_MAX;

/// Both of the functions that a chip without a 64-bit division calls, whatever this computer calls.
std::uint64_t by_parts(std::uint64_t n, std::uint64_t d) {
  return d <= kLargest32 ? quotient_by_parts(n, static_cast<std::uint32_t>(d)) : quotient_by_parts_64(n, d);
}

/// Random, or WHISKER_SEED; printed.
std::uint64_t seed() {
  const char* const given = std::getenv("WHISKER_SEED");
  const std::uint64_t seed = given != nullptr ? std::strtoull(given, nullptr, 10) : std::random_device{}();
  std::printf("WHISKER_SEED=%llu\n", static_cast<unsigned long long>(seed));
  return seed;
}

/// 0, the powers of two, the largest number, and their neighbours.
std::vector<std::uint64_t> edges() {
  std::vector<std::uint64_t> all{0};
  for (int bit = 0; bit < 64; ++bit) {
    const std::uint64_t power = std::uint64_t{1} << bit;
    for (const std::uint64_t x : {power - 1, power, power + 1, 0U - power}) all.push_back(x);
  }
  return all;
}

TEST(Product, ByPartsIsThatOfTheHostAtAllEdges) {
  const auto all = edges();
  for (const std::uint64_t x : all) {
    for (const std::uint64_t y : all) {
      const auto a = static_cast<std::uint32_t>(x), b = static_cast<std::uint32_t>(y);
      ASSERT_EQ(unsigned_by_parts(a, b), std::uint64_t{a} * b) << a << " * " << b;
      const std::int32_t c = as_signed(a), d = as_signed(b);
      ASSERT_EQ(signed_by_parts(c, d), std::int64_t{c} * d) << c << " * " << d;
    }
  }
}

TEST(Product, ByPartsIsThatOfTheHostAtRandom) {
  std::mt19937_64 random(seed());
  for (std::uint64_t i = 0; i < test::effort(333'334, 200'000'000); ++i) {
    const auto a = static_cast<std::uint32_t>(random()), b = static_cast<std::uint32_t>(random());
    if (unsigned_by_parts(a, b) != std::uint64_t{a} * b) FAIL() << a << " * " << b;
    const std::int32_t c = as_signed(a), d = as_signed(b);
    if (signed_by_parts(c, d) != std::int64_t{c} * d) FAIL() << c << " * " << d;
  }
}

TEST(Quotient, IsThatOfTheHostAtAllEdges) {
  for (const std::uint64_t d : edges()) {
    if (d == 0) continue;
    for (const std::uint64_t n : edges()) {
      ASSERT_EQ(by_parts(n, d), n / d) << n << " / " << d;
      ASSERT_EQ(quotient_64(n, d), n / d) << n << " / " << d;
    }
    // Where the quotient changes.
    for (const std::uint64_t whole : edges()) {
      const std::uint64_t n = whole * d;
      ASSERT_EQ(by_parts(n, d), n / d) << n << " / " << d;
      ASSERT_EQ(by_parts(n - 1, d), (n - 1) / d) << n - 1 << " / " << d;
    }
  }
}

TEST(Quotient, IsThatOfTheHostAtRandom) {
  std::mt19937_64 random(seed());
  // Every size of both is as likely as any other.
  const auto sized = [&] { return random() >> (random() % 64); };
  for (std::uint64_t i = 0; i < test::effort(333'334, 200'000'000); ++i) {
    const std::uint64_t d = sized();
    if (d == 0) continue;
    const std::uint64_t whole = sized() * d;
    for (const std::uint64_t n : {sized(), whole, whole - 1}) {
      if (by_parts(n, d) != n / d) FAIL() << n << " / " << d << " is not " << by_parts(n, d);
    }
  }
}

TEST(Quotient, HasTheSignOfTheHostsAtRandom) {
  std::mt19937_64 random(seed());
  const auto sized = [&] {
    const auto size = static_cast<std::int64_t>(random() >> (1 + random() % 63));
    return random() % 2 == 0 ? size : -size;
  };
  for (std::uint64_t i = 0; i < test::effort(333'334, 200'000'000); ++i) {
    const std::int64_t n = sized(), d = sized();
    const std::int32_t short_d = as_signed(static_cast<std::uint32_t>(random() >> (random() % 63)));
    if (d != 0 && quotient_64(n, d) != n / d) FAIL() << n << " / " << d;
    if (short_d != 0 && quotient(n, short_d) != n / short_d) FAIL() << n << " / " << short_d;
  }
}

TEST(Quotient, RoundsTowardsZero) {
  EXPECT_EQ(quotient(INT64_C(-7), INT32_C(2)), -3);
  EXPECT_EQ(quotient(INT64_C(-70'000'000'000), INT32_C(3)), -23'333'333'333);
  EXPECT_EQ(quotient(INT64_C(70'000'000'000), INT32_C(3)), 23'333'333'333);
  EXPECT_EQ(quotient(INT64_C(-70'000'000'000), INT32_C(-3)), 23'333'333'333);
  EXPECT_EQ(quotient(INT64_C(70'000'000'000), INT32_C(-3)), -23'333'333'333);
  EXPECT_EQ(quotient(INT64_C(70'000'000'000), INT32_MIN), -32);
  EXPECT_EQ(quotient(std::int64_t{INT32_MIN}, INT32_C(-1)), std::int64_t{INT32_MAX} + 1);
  EXPECT_EQ(quotient(INT64_MIN, INT32_C(1)), INT64_MIN);
  EXPECT_EQ(quotient(INT64_MIN, INT32_MAX), INT64_MIN / INT32_MAX);
  EXPECT_EQ(quotient(std::int64_t{INT32_MIN}, INT32_C(1)), INT32_MIN);
  EXPECT_EQ(quotient_64(INT64_MIN, INT64_MAX), -1);
  EXPECT_EQ(quotient_64(INT64_C(-70'000'000'000), INT64_C(30'000'000'000)), -2);
  EXPECT_EQ(quotient_64(INT64_C(70'000'000'000), INT64_C(-30'000'000'000)), -2);
  EXPECT_EQ(quotient_64(INT64_C(-7), INT64_C(2)), -3);
  EXPECT_EQ(quotient_64(INT64_C(-7), INT64_C(-2)), 3);
}

TEST(Quotient, RoundedToNearestWithAnyDenominator) {
  EXPECT_EQ(divide_rounded(INT64_C(5), INT32_C(2)), 3);
  EXPECT_EQ(divide_rounded(INT64_C(-5), INT32_C(2)), -3);
  EXPECT_EQ(divide_rounded(std::int64_t{INT32_MIN}, INT32_C(1)), INT32_MIN);
  EXPECT_EQ(divide_rounded_64(INT64_C(75'000'000'000), INT64_C(30'000'000'000)), 3);
  EXPECT_EQ(divide_rounded_64(INT64_C(-75'000'000'000), INT64_C(30'000'000'000)), -3);
  EXPECT_EQ(divide_rounded_64(INT64_C(74'999'999'999), INT64_C(30'000'000'000)), 2);
}

TEST(Quotient, CountsLeadingZeros) {
  for (int bit = 0; bit < 32; ++bit) EXPECT_EQ(leading_zeros(UINT32_MAX >> bit), bit);
}

}  // namespace
}  // namespace whisker
