#include "firmware/math/quotient.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "firmware/math/fixed.hpp"
#include "tests/effort.hpp"

namespace whisker {
namespace {

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
