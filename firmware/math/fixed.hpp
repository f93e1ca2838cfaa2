/// Integer arithmetic with defined rounding and overflow.
///
/// Rounding is to nearest, ties away from zero, so every function here is odd: f(-x) == -f(x). Overflow
/// saturates. No signed value is shifted.
#pragma once

#include <stdint.h>

#include "firmware/math/quotient.hpp"

namespace whisker {

/// x, which must fit. A cast that may change the value is a static_cast.
template <class To, class From>
constexpr To narrow(From x) noexcept {
  WHISKER_ASSERT(static_cast<From>(static_cast<To>(x)) == x && (static_cast<To>(x) < To{}) == (x < From{}));
  return static_cast<To>(x);
}

constexpr int16_t saturate16(int32_t x) noexcept {
  return x > INT16_MAX ? INT16_MAX : x < INT16_MIN ? INT16_MIN : static_cast<int16_t>(x);
}

constexpr int32_t saturating_add(int32_t a, int32_t b) noexcept {
  int32_t sum = 0;
  if (!__builtin_add_overflow(a, b, &sum)) return sum;
  return a < 0 ? INT32_MIN : INT32_MAX;
}

constexpr int32_t saturating_subtract(int32_t a, int32_t b) noexcept {
  int32_t difference = 0;
  if (!__builtin_sub_overflow(a, b, &difference)) return difference;
  return a < 0 ? INT32_MIN : INT32_MAX;
}

/// -x, with -INT32_MIN == INT32_MAX.
constexpr int32_t saturating_negate(int32_t x) noexcept { return x == INT32_MIN ? INT32_MAX : -x; }

/// x > INT32_MIN.
constexpr int32_t absolute(int32_t x) noexcept { return x < 0 ? -x : x; }

/// The number whose two's complement this is.
constexpr int32_t as_signed(uint32_t raw) noexcept {
  return raw <= INT32_MAX ? static_cast<int32_t>(raw) : -static_cast<int32_t>(~raw) - 1;
}

constexpr int32_t saturate32(int64_t x) noexcept {
  // Nearly every product saturates, so this is short: one comparison, and INT32_MIN follows INT32_MAX.
  const int32_t low = as_signed(static_cast<uint32_t>(static_cast<uint64_t>(x)));
  return low == x ? low : as_signed(UINT32_C(0x7FFFFFFF) + (x < 0 ? 1U : 0U));
}

/// a + b must fit 64 bits. Called, not inlined: short code at every place.
[[gnu::noinline]] constexpr int32_t saturating_add(int32_t a, int64_t b) noexcept {
  WHISKER_ASSERT(b <= INT64_MAX - INT32_MAX && b >= INT64_MIN - INT32_MIN);
  return saturate32(a + b);
}

#if defined(__ARM_ARCH_6M__)
constexpr bool kMultipliesByParts = true;  // the product of 32 bits by 32 is a call of the compiler's library
#else
constexpr bool kMultipliesByParts = false;
#endif

/// a * b by products of 16 bits.
[[gnu::always_inline]] constexpr uint64_t unsigned_by_parts(uint32_t a, uint32_t b) noexcept {
  const uint32_t a_low = a & UINT16_MAX, a_high = a >> 16, b_low = b & UINT16_MAX, b_high = b >> 16;
  const uint32_t low = a_low * b_low;
  const uint32_t first = a_high * b_low + (low >> 16);
  const uint32_t second = a_low * b_high + (first & UINT16_MAX);
  const uint32_t high = a_high * b_high + (first >> 16) + (second >> 16);
  return uint64_t{high} << 32 | (second << 16 | (low & UINT16_MAX));
}

[[gnu::noinline]] constexpr int64_t signed_by_parts(int32_t a, int32_t b) noexcept {
  const auto raw_a = static_cast<uint32_t>(a), raw_b = static_cast<uint32_t>(b);
  const uint64_t raw = unsigned_by_parts(raw_a, raw_b);
  // A negative factor's raw value is 2^32 too large.
  const uint32_t high = static_cast<uint32_t>(raw >> 32) - (a < 0 ? raw_b : 0) - (b < 0 ? raw_a : 0);
  return static_cast<int64_t>(uint64_t{high} << 32 | static_cast<uint32_t>(raw));
}

/// a * b.
[[gnu::always_inline]] constexpr uint64_t product(uint32_t a, uint32_t b) noexcept {
  return kMultipliesByParts ? unsigned_by_parts(a, b) : uint64_t{a} * b;
}
constexpr int64_t signed_product(int32_t a, int32_t b) noexcept {
  return kMultipliesByParts ? signed_by_parts(a, b) : int64_t{a} * b;
}

/// |x| < 2^31.5.
constexpr int64_t square(int64_t x) noexcept {
  WHISKER_ASSERT(x >= -INT64_C(3037000499) && x <= INT64_C(3037000499));
  return x * x;
}

/// n / d to nearest, ties away from zero. d > 0; |n| + d / 2 must fit.
[[gnu::noinline]] constexpr int64_t divide_rounded(int64_t n, int32_t d) noexcept {
  WHISKER_ASSERT(d > 0 && n <= INT64_MAX - d / 2 && n >= INT64_MIN + d / 2);
  const auto half = static_cast<int32_t>(static_cast<uint32_t>(d) / 2);
  return quotient(n < 0 ? n - half : n + half, d);
}
/// The same for numerators of 32 bits.
[[gnu::noinline]] constexpr int32_t divide_rounded_32(int32_t n, int32_t d) noexcept {
  WHISKER_ASSERT(d > 0);
  const int32_t whole = n / d;
  const int32_t rest = n - whole * d;
  const auto half = static_cast<int32_t>((static_cast<uint32_t>(d) + 1) / 2);
  return rest >= half ? whole + 1 : rest <= -half ? whole - 1 : whole;
}
/// The same for denominators that may have more than 32 bits.
[[gnu::noinline]] constexpr int64_t divide_rounded_64(int64_t n, int64_t d) noexcept {
  WHISKER_ASSERT(d > 0 && n <= INT64_MAX - d / 2 && n >= INT64_MIN + d / 2);
  return quotient_64(n < 0 ? n - d / 2 : n + d / 2, d);
}

/// x / 2^bits to nearest, ties away from zero. 0 < bits < 63.
constexpr int64_t scale_down_by(int64_t x, int bits) noexcept {
  WHISKER_ASSERT(bits > 0 && bits < 63);
  const uint64_t size = x < 0 ? 0U - static_cast<uint64_t>(x) : static_cast<uint64_t>(x);
  const int64_t quotient = static_cast<int64_t>(((size >> (bits - 1)) + 1) >> 1);
  return x < 0 ? -quotient : quotient;
}

/// x / 2^kBits to nearest, ties away from zero. |x| + 2^(kBits - 1) must fit.
template <int kBits>
constexpr int64_t scale_down(int64_t x) noexcept {
  static_assert(kBits > 0 && kBits < 62);
  const uint64_t size = x < 0 ? 0U - static_cast<uint64_t>(x) : static_cast<uint64_t>(x);
  const int64_t quotient = static_cast<int64_t>((size + (UINT64_C(1) << (kBits - 1))) >> kBits);
  return x < 0 ? -quotient : quotient;
}

template <int kBits>
constexpr int32_t scale_down(int32_t x) noexcept {
  static_assert(kBits > 0 && kBits < 30);
  constexpr int32_t kOne = INT32_C(1) << kBits;
  WHISKER_ASSERT(x <= INT32_MAX - kOne / 2 && x >= INT32_MIN + kOne / 2);
  return (x < 0 ? x - kOne / 2 : x + kOne / 2) / kOne;
}

/// a * b / 2^kBits to nearest, ties up, by products of 16 bits; it must fit. a, b < 2^31.
template <int kBits>
[[gnu::always_inline]] constexpr uint32_t scaled_product_by_parts(uint32_t a, uint32_t b) noexcept {
  static_assert(kBits > 16 && kBits <= 32);
  WHISKER_ASSERT(a <= INT32_MAX && b <= INT32_MAX);
  const uint32_t a_low = a & UINT16_MAX, a_high = a >> 16, b_low = b & UINT16_MAX, b_high = b >> 16;
  // What the lowest 16 bits of the product hold reaches no bit of the result.
  const uint32_t middle = a_high * b_low + a_low * b_high + (a_low * b_low >> 16);
  const uint32_t high = a_high * b_high;
  return (high << (32 - kBits)) + ((middle + (UINT32_C(1) << (kBits - 17))) >> (kBits - 16));
}

/// a * b / c to nearest, saturating. c > 0.
constexpr int32_t multiply_divide(int32_t a, int32_t b, int32_t c) noexcept {
  return saturate32(divide_rounded(signed_product(a, b), c));
}

/// A number with kFraction binary places in an integer of type Rep; arithmetic saturates.
template <int kFraction, class Rep>
class Fixed {
 public:
  static constexpr int32_t kOne = INT32_C(1) << kFraction;

  constexpr Fixed() noexcept = default;
  static constexpr Fixed from_raw(Rep raw) noexcept {
    Fixed f;
    f.raw_ = raw;
    return f;
  }
  /// numerator / denominator to nearest. denominator > 0.
  static constexpr Fixed ratio(int32_t numerator, int32_t denominator) noexcept {
    return from_raw(clamp(divide_rounded(signed_product(numerator, kOne), denominator)));
  }
  constexpr Rep raw() const noexcept { return raw_; }

  friend constexpr bool operator==(Fixed a, Fixed b) noexcept { return a.raw_ == b.raw_; }
  friend constexpr bool operator!=(Fixed a, Fixed b) noexcept { return a.raw_ != b.raw_; }
  friend constexpr bool operator<(Fixed a, Fixed b) noexcept { return a.raw_ < b.raw_; }
  friend constexpr bool operator>(Fixed a, Fixed b) noexcept { return a.raw_ > b.raw_; }
  friend constexpr bool operator<=(Fixed a, Fixed b) noexcept { return a.raw_ <= b.raw_; }
  friend constexpr bool operator>=(Fixed a, Fixed b) noexcept { return a.raw_ >= b.raw_; }
  friend constexpr Fixed operator-(Fixed a) noexcept { return from_raw(clamp(-int64_t{a.raw_})); }
  friend constexpr Fixed operator+(Fixed a, Fixed b) noexcept {
    return from_raw(clamp(int64_t{a.raw_} + b.raw_));
  }
  friend constexpr Fixed operator-(Fixed a, Fixed b) noexcept {
    return from_raw(clamp(int64_t{a.raw_} - b.raw_));
  }
  friend constexpr Fixed operator*(Fixed a, Fixed b) noexcept {
    return from_raw(clamp(scale_down<kFraction>(signed_product(a.raw_, b.raw_))));
  }

 private:
  static_assert(sizeof(Rep) <= 4, "products are formed in 64 bits");
  static constexpr Rep clamp(int64_t x) noexcept {
    constexpr int64_t kMax = static_cast<int64_t>((UINT64_C(1) << (8 * sizeof(Rep) - 1)) - 1);
    return static_cast<Rep>(x > kMax ? kMax : x < -kMax - 1 ? -kMax - 1 : x);
  }
  Rep raw_ = 0;
};

using Q7 = Fixed<7, int16_t>;    ///< the fuzzy inputs D and R; resolution 1/128
using Q14 = Fixed<14, int16_t>;  ///< the fuzzy outputs SA and SD; [-2, 2)
using Q15 = Fixed<15, int16_t>;  ///< [-1, 1)
using Q30 = Fixed<30, int32_t>;  ///< sines and cosines; [-2, 2)

/// In 2^-14, to nearest.
constexpr int16_t q14(Q30 x) noexcept { return narrow<int16_t>(scale_down<16>(x.raw())); }

static_assert((Q15::from_raw(INT16_MIN) * Q15::from_raw(INT16_MIN)).raw() == INT16_MAX);
static_assert(scaled_product_by_parts<30>(INT32_MAX, UINT32_C(1) << 30) == INT32_MAX);
static_assert(scaled_product_by_parts<30>(1686629674, 1073741823) ==
              (product(1686629674, 1073741823) + (UINT64_C(1) << 29)) >> 30);
static_assert(scale_down_by(24, 4) == 2 && scale_down_by(-24, 4) == -2 && scale_down_by(23, 4) == 1);
static_assert(scale_down<4>(INT32_C(24)) == 2 && scale_down<4>(INT32_C(-24)) == -2);

}  // namespace whisker
