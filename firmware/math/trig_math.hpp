/// Formulas of trig.hpp, and the choice between compile time and trig.cpp.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "firmware/math/trig.hpp"

namespace whisker {
namespace at_run_time {
Q30 sin(Angle a) noexcept;
Angle atan2(int32_t y, int32_t x) noexcept;
uint32_t square_root(uint64_t x) noexcept;
uint32_t square_root_32(uint32_t x) noexcept;
Length norm(Vec v) noexcept;
bool farther(Vec v, Length length) noexcept;
Vec polar(Angle direction, Length length) noexcept;
Length along(Vec v, Facing direction) noexcept;
}  // namespace at_run_time

namespace formula {

// Minimax fits (Remez exchange) of sin(x pi / 2), unit 2^-30, and of atan(x), unit 2^-32 turn.
constexpr uint32_t kSine[] = {1686629674, 693597876, 85564854, 5016767, 161942};
constexpr uint32_t kArcTangent[] = {683565198, 227850059, 136616721, 96801258, 71767194,
                                    49455063,  27193166,  9844330,   1679347};

/// Such a multiple of a factor makes the upper half of its product with a Q30.
constexpr uint32_t kQ30Scale = kMultipliesByParts ? 1 : 4;
/// To nearest, ties up. Without overflow; b < 2^31.
[[gnu::always_inline]] constexpr uint32_t product_q30(uint32_t scaled_a, uint32_t b) noexcept {
  if (kMultipliesByParts) return scaled_product_by_parts<30>(scaled_a, b);
  const uint64_t whole = product(scaled_a, b);
  return static_cast<uint32_t>(whole >> 32) + (static_cast<uint32_t>(whole) >> 31);
}

/// c[kFrom] - c[kFrom + 1] x^2 + ..., without a loop.
template <size_t kFrom, size_t kTerms>
[[gnu::always_inline]] constexpr uint32_t alternating(const uint32_t (&c)[kTerms],
                                                      uint32_t scaled_square) noexcept {
  if constexpr (kFrom + 1 == kTerms) {
    return c[kFrom];
  } else {
    return c[kFrom] - product_q30(scaled_square, alternating<kFrom + 1>(c, scaled_square));
  }
}

/// c[0] x - c[1] x^3 + c[2] x^5 - ... for x in [0, 1) as Q30, in the unit of the coefficients, which fall: so
/// no sum is negative.
template <size_t kTerms>
[[gnu::always_inline]] constexpr uint32_t odd_polynomial(const uint32_t (&c)[kTerms],
                                                         uint32_t x_q30) noexcept {
  const uint32_t scaled_x = kQ30Scale * x_q30;
  const uint32_t scaled_square = kQ30Scale * product_q30(scaled_x, x_q30);
  if (!kMultipliesByParts) return product_q30(scaled_x, alternating<0>(c, scaled_square));
  uint32_t sum = c[kTerms - 1];
  for (size_t i = kTerms - 1; i-- > 0;) sum = c[i] - product_q30(scaled_square, sum);
  return product_q30(scaled_x, sum);
}

/// The same for x = 1.
template <size_t kTerms>
constexpr uint32_t at_one(const uint32_t (&c)[kTerms]) noexcept {
  uint32_t sum = 0;
  for (size_t i = kTerms; i-- > 0;) sum = c[i] - sum;
  return sum;
}
constexpr uint32_t kSineOfOne = at_one(kSine);
constexpr uint32_t kArcTangentOfOne = at_one(kArcTangent);
static_assert(kSineOfOne > Q30::kOne && kArcTangentOfOne - (UINT32_C(1) << 29) < 8);
constexpr uint32_t kUnit = Q30::kOne;

[[gnu::always_inline]] constexpr Q30 sin(Angle a) noexcept {
  const uint32_t half = UINT32_C(1) << 31;
  const uint32_t quarter = UINT32_C(1) << 30;
  const bool negative = a.raw() > half;
  uint32_t first_half = negative ? 0U - a.raw() : a.raw();
  if (first_half > quarter) first_half = half - first_half;
  const uint32_t s = first_half == kUnit ? kSineOfOne : odd_polynomial(kSine, first_half);
  const int32_t capped = s > kUnit ? Q30::kOne : static_cast<int32_t>(s);
  return Q30::from_raw(negative ? -capped : capped);
}

[[gnu::always_inline]] constexpr Angle atan2(int32_t y, int32_t x) noexcept {
  const uint32_t ax = magnitude(x);
  const uint32_t ay = magnitude(y);
  if (ax == 0 && ay == 0) return Angle{};
  const uint32_t low = ax < ay ? ax : ay;
  const uint32_t high = ax < ay ? ay : ax;
  const uint64_t ratio = quotient((uint64_t{low} << 30) + high / 2, high);
  uint32_t turn =
      ratio == kUnit ? kArcTangentOfOne : odd_polynomial(kArcTangent, static_cast<uint32_t>(ratio));
  if (ax < ay) turn = (UINT32_C(1) << 30) - turn;
  if (x < 0) turn = (UINT32_C(1) << 31) - turn;
  return Angle::from_raw(y < 0 ? 0U - turn : turn);
}

/// The root of x, 2^-8, less 1: of the middle of all x in [1/4, 1) whose first 8 places are these.
struct FirstRoots {
  uint8_t of[192] = {};

  constexpr FirstRoots() noexcept {
    uint32_t root = 256;  // 2^-9
    for (uint32_t i = 0; i < sizeof of; ++i) {
      const uint32_t middle = (2 * (i + 64) + 1) << 9;  // 2^-18
      while ((2 * root + 1) * (2 * root + 1) < 4 * middle) ++root;
      of[i] = static_cast<uint8_t>(root - 256);
    }
  }
};
constexpr FirstRoots kFirstRoots;

/// Their reciprocals, 2^-8, less 1.
struct Reciprocals {
  uint8_t of[192] = {};

  constexpr Reciprocals() noexcept {
    for (uint32_t i = 0; i < sizeof of; ++i) {
      const uint32_t root = 256U + kFirstRoots.of[i];
      of[i] = static_cast<uint8_t>((UINT16_MAX + root / 2) / root - 1);
    }
  }
};
constexpr Reciprocals kReciprocals;

struct RootAndRest {
  uint32_t root;
  uint32_t rest;  // x - root^2
};

/// One step of Newton's from the table. x >= 2^30. kDivides: by a division, else by the reciprocal.
template <bool kDivides>
[[gnu::always_inline]] constexpr RootAndRest root_and_rest(uint32_t x) noexcept {
  WHISKER_ASSERT(x >> 30 != 0);
  const uint32_t place = (x >> 24) - 64;
  const uint32_t first = (256U + kFirstRoots.of[place]) << 7;
  if (kDivides) {
    // Newton's step is never too small, and here it is too large by less than 1.
    const uint32_t root = (first + x / first) >> 1;
    const uint32_t rest = x - root * root;
    return rest <= 2 * root ? RootAndRest{root, rest} : RootAndRest{root - 1, rest + 2 * root - 1};
  }
  // Here it is wrong by at most 1. The rest of the first root is positive with this.
  const uint32_t reciprocal = 1U + kReciprocals.of[place];
  const uint32_t above = UINT32_C(1) << 25;
  const uint32_t root = first + ((x - first * first + above) / 256 * reciprocal >> 16) - 2 * reciprocal;
  const uint32_t rest = x - root * root;
  if (rest > UINT32_MAX / 2) return {root - 1, rest + 2 * root - 1};
  return rest <= 2 * root ? RootAndRest{root, rest} : RootAndRest{root + 1, rest - 2 * root - 1};
}
[[gnu::always_inline]] constexpr RootAndRest root_and_rest(uint32_t x) noexcept {
  return root_and_rest<!kDividesSlowly>(x);
}

[[gnu::always_inline]] constexpr uint32_t square_root_32(uint32_t x) noexcept {
  if (x == 0) return 0;
  const int places = leading_zeros(x) & ~1;
  return root_and_rest(x << places).root >> places / 2;
}

/// The lower half of the root by one division (Zimmermann, Karatsuba Square Root, INRIA RR-3805, 1999).
[[gnu::always_inline]] constexpr uint32_t square_root(uint64_t x) noexcept {
  if (x <= UINT32_MAX) return whisker::square_root_32(static_cast<uint32_t>(x));
  const int places = leading_zeros(static_cast<uint32_t>(x >> 32)) & ~1;
  const uint64_t scaled = x << places;
  const uint32_t low = static_cast<uint32_t>(scaled);
  const RootAndRest upper = root_and_rest(static_cast<uint32_t>(scaled >> 32));
  const uint32_t half = upper.rest << 15 | low >> 17;
  uint32_t lower = half / upper.root;
  if (lower > UINT16_MAX) lower = UINT16_MAX;
  const uint32_t rest = 2 * (half - lower * upper.root) + (low >> 16 & 1);  // 2^16
  uint32_t root = upper.root << 16 | lower;
  if (rest <= UINT16_MAX && (rest << 16 | (low & UINT16_MAX)) < lower * lower) --root;
  return root >> places / 2;
}

constexpr uint64_t squared(Vec v) noexcept {
  const uint32_t x = magnitude(v.x.raw()), y = magnitude(v.y.raw());
  return product(x, x) + product(y, y);
}

[[gnu::always_inline]] constexpr Length norm(const Vec& v) noexcept {
  const uint32_t root = whisker::square_root(squared(v));
  return Length::from_raw(root > INT32_MAX ? INT32_MAX : static_cast<int32_t>(root));
}

[[gnu::always_inline]] constexpr bool farther(const Vec& v, Length length) noexcept {
  const uint32_t beyond = magnitude(length.raw()) + 1;
  return length < Length{} || squared(v) >= product(beyond, beyond);
}

[[gnu::always_inline]] constexpr Vec polar(Angle direction, Length length) noexcept {
  return {length * whisker::cos(direction), length * whisker::sin(direction)};
}

[[gnu::always_inline]] constexpr Length along(const Vec& v, Facing direction) noexcept {
  const int64_t x = scale_down<4>(signed_product(v.x.raw(), direction.cos.raw()));
  const int64_t y = scale_down<4>(signed_product(v.y.raw(), direction.sin.raw()));
  return Length::from_raw(saturate32(scale_down<26>(x + y)));
}

}  // namespace formula

[[gnu::always_inline]] constexpr Q30 sin(Angle a) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::sin(a);
  return at_run_time::sin(a);
}
constexpr Q30 cos(Angle a) noexcept { return sin(Angle::turns(1, 4) - a); }
[[gnu::always_inline]] constexpr Angle atan2(int32_t y, int32_t x) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::atan2(y, x);
  return at_run_time::atan2(y, x);
}
constexpr Angle bearing(const Vec& v) noexcept { return atan2(v.y.raw(), v.x.raw()); }
[[gnu::always_inline]] constexpr uint32_t square_root(uint64_t x) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::square_root(x);
  return at_run_time::square_root(x);
}
[[gnu::always_inline]] constexpr uint32_t square_root_32(uint32_t x) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::square_root_32(x);
  return at_run_time::square_root_32(x);
}
[[gnu::always_inline]] constexpr Length norm(const Vec& v) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::norm(v);
  return at_run_time::norm(v);
}
[[gnu::always_inline]] constexpr bool farther(const Vec& v, Length length) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::farther(v, length);
  return at_run_time::farther(v, length);
}
[[gnu::always_inline]] constexpr Vec polar(Angle direction, Length length) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::polar(direction, length);
  return at_run_time::polar(direction, length);
}
[[gnu::always_inline]] constexpr Length along(const Vec& v, Facing direction) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::along(v, direction);
  return at_run_time::along(v, direction);
}
constexpr Facing facing(Angle direction) noexcept { return {cos(direction), sin(direction)}; }
constexpr Vec polar(Facing direction, Length length) noexcept {
  return {length * direction.cos, length * direction.sin};
}
constexpr Length along(const Vec& v, Angle direction) noexcept { return along(v, facing(direction)); }
constexpr Length across(const Vec& v, Angle direction) noexcept { return across(v, facing(direction)); }

}  // namespace whisker
