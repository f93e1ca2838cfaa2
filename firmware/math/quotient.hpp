/// Division of 64-bit integers. Like /, it rounds towards zero; the denominator must not be 0, but every loop
/// is bounded.
///
/// A 32-bit chip has no instruction for it, and the function of the compiler's library is long, because it
/// takes denominators of 64 bits, too. Nearly all denominators here have 32 bits.
#pragma once

#include <stdint.h>

#include "firmware/math/assert.hpp"

namespace whisker {

/// Whether quotients come from quotient_by_parts, which needs fast instructions for 32-bit quotients, 64-bit
/// products and leading zeros. Chips that divide slowly take its first case from it, and the others, like
/// other processors, from /: they divide 64 bits in hardware, or lack one of these.
#if defined(__arm__) && defined(__ARM_FEATURE_IDIV) && defined(__ARM_FEATURE_CLZ)
constexpr bool kDividesByParts = true;
#else
constexpr bool kDividesByParts = false;
#endif

/// A division of 32 bits is a call of the compiler's library, which takes as long as 20 products.
#if defined(__arm__) && !defined(__ARM_FEATURE_IDIV)
constexpr bool kDividesSlowly = true;
#else
constexpr bool kDividesSlowly = false;
#endif

constexpr uint32_t magnitude(int32_t x) noexcept {
  return x < 0 ? 0U - static_cast<uint32_t>(x) : static_cast<uint32_t>(x);
}

constexpr uint64_t magnitude(int64_t x) noexcept {
  return x < 0 ? 0U - static_cast<uint64_t>(x) : static_cast<uint64_t>(x);
}

/// x > 0.
constexpr int leading_zeros(uint32_t x) noexcept {
  WHISKER_ASSERT(x > 0);
  return __builtin_clzl(x) - static_cast<int>(8 * (sizeof(unsigned long) - sizeof x));
}

/// Whether quotient_in_two() has room.
template <int kPlaces>
constexpr bool fits_two(uint64_t n, uint32_t d) noexcept {
  return n >> (32 + kPlaces) == 0 && d >> (32 - kPlaces) == 0;
}
/// n / d: a quotient of the upper 32 bits, then one of the rest with so many places.
template <int kPlaces>
constexpr uint64_t quotient_in_two(uint64_t n, uint32_t d) noexcept {
  const uint32_t part = static_cast<uint32_t>(n >> kPlaces);
  const uint32_t whole = part / d;
  const uint32_t places = static_cast<uint32_t>(n) & ((UINT32_C(1) << kPlaces) - 1);
  const uint32_t below = (part - whole * d) << kPlaces | places;
  return (uint64_t{whole} << kPlaces) + below / d;
}

/// n / d from 32-bit quotients.
[[gnu::noinline]] constexpr uint64_t quotient_by_parts(uint64_t n, uint32_t d) noexcept {
  // Nearly all numerators and denominators are so small.
  if (fits_two<14>(n, d)) return quotient_in_two<14>(n, d);
  if (fits_two<10>(n, d)) return quotient_in_two<10>(n, d);
  if (kDividesSlowly) return n / d;
  const uint32_t high = static_cast<uint32_t>(n >> 32);
  const uint32_t upper = high / d;
  // Shifted until the denominator has 32 bits. Then the rest is less than 2^32 denominators.
  const int places = leading_zeros(d);
  const uint32_t denominator = d << places;
  uint64_t rest = (uint64_t{high - upper * d} << 32 | static_cast<uint32_t>(n)) << places;
  // More than the denominator, by less than a part in 2^15. So no quotient is too large, and the rest stays
  // >= 0.
  const uint32_t above = (denominator >> 16) + 1;  // 2^16
  uint32_t lower = (static_cast<uint32_t>(rest >> 32) / above) << 16;
  rest -= uint64_t{lower} * denominator;
  // Less than 3 * 2^16 denominators are left, and then less than 11.
  const uint32_t part = (static_cast<uint32_t>(rest >> 18) / above) << 2;
  lower += part;
  rest -= uint64_t{part} * denominator;
  for (int i = 0; i < 10 && rest >= denominator; ++i, rest -= denominator) ++lower;
  return uint64_t{upper} << 32 | lower;
}

/// n / d with a denominator of more than 32 bits, from the quotient by its upper 31 bits.
[[gnu::noinline]] constexpr uint64_t quotient_by_parts_64(uint64_t n, uint64_t d) noexcept {
  const int places = 33 - leading_zeros(static_cast<uint32_t>(d >> 32));
  const uint32_t above = static_cast<uint32_t>(d >> places) + 1;  // 2^places
  uint64_t whole = quotient_by_parts(n >> places, above);
  // Less than 6 denominators are left.
  uint64_t rest = n - whole * d;
  for (; rest >= d; rest -= d) ++whole;
  return whole;
}

/// n / d.
[[gnu::always_inline]] constexpr uint64_t quotient(uint64_t n, uint32_t d) noexcept {
  WHISKER_ASSERT(d != 0);
  return kDividesByParts || kDividesSlowly ? quotient_by_parts(n, d) : n / d;
}
constexpr int64_t quotient(int64_t n, int32_t d) noexcept {
  WHISKER_ASSERT(d != 0);
  // Most numerators are small, and 32-bit division is much faster on most chips. INT32_MIN / -1 has no room.
  const int32_t small = static_cast<int32_t>(n);
  if (small == n && d != -1) return small / d;
  const uint64_t size = quotient(magnitude(n), magnitude(d));
  return static_cast<int64_t>((n < 0) == (d < 0) ? size : 0U - size);
}

/// The same for denominators that may have more than 32 bits.
[[gnu::always_inline]] constexpr uint64_t quotient_64(uint64_t n, uint64_t d) noexcept {
  WHISKER_ASSERT(d != 0);
  if (d <= UINT32_MAX) return quotient(n, static_cast<uint32_t>(d));
  return kDividesByParts ? quotient_by_parts_64(n, d) : n / d;
}
constexpr int64_t quotient_64(int64_t n, int64_t d) noexcept {
  const uint64_t size = quotient_64(magnitude(n), magnitude(d));
  return static_cast<int64_t>((n < 0) == (d < 0) ? size : 0U - size);
}

static_assert(quotient_by_parts(UINT64_MAX, 1) == UINT64_MAX);
static_assert(quotient_by_parts(UINT64_MAX, UINT32_MAX) == UINT64_C(0x100000001));
static_assert(quotient_by_parts_64(UINT64_MAX, UINT64_C(1) << 32) == UINT32_MAX);
static_assert(quotient(INT64_MIN, INT32_C(1)) == INT64_MIN);

}  // namespace whisker
