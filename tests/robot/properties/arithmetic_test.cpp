/// Fixed-point operations against 128-bit integers and long doubles, at random and at boundary values.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "firmware/math/angle.hpp"
#include "firmware/math/fixed.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"

namespace whisker {
namespace {

__extension__ using Wide = __int128;

Wide rounded(Wide n, Wide d) { return (n < 0 ? n - d / 2 : n + d / 2) / d; }

template <class T>
Wide saturated(Wide x) {
  const Wide low = std::numeric_limits<T>::min();
  const Wide high = std::numeric_limits<T>::max();
  return x < low ? low : x > high ? high : x;
}

/// Any value, the limits, the powers of two, and their neighbours.
template <class T>
rc::Gen<T> edgy() {
  const auto near_a_power = rc::gen::map(
      rc::gen::pair(rc::gen::inRange(0, static_cast<int>(8 * sizeof(T))), rc::gen::inRange(-2, 3)),
      [](const std::pair<int, int>& p) {
        return static_cast<T>((std::uint64_t{1} << p.first) + static_cast<std::uint64_t>(p.second));
      });
  return rc::gen::oneOf(
      rc::gen::arbitrary<T>(), near_a_power,
      rc::gen::map(near_a_power, [](T x) { return static_cast<T>(0U - static_cast<std::uint64_t>(x)); }),
      rc::gen::map(rc::gen::arbitrary<std::uint64_t>(), [](std::uint64_t x) { return static_cast<T>(x); }));
}

std::int32_t edge32() { return *edgy<std::int32_t>(); }
std::int32_t positive32() {
  return *rc::gen::suchThat(edgy<std::int32_t>(), [](std::int32_t x) { return x > 0; });
}

RC_GTEST_PROP(Arithmetic, SumsSaturate, ()) {
  const std::int32_t a = edge32();
  const std::int32_t b = edge32();
  RC_ASSERT(saturating_add(a, b) == saturated<std::int32_t>(Wide{a} + b));
  RC_ASSERT(saturating_subtract(a, b) == saturated<std::int32_t>(Wide{a} - b));
  RC_ASSERT(saturating_negate(a) == saturated<std::int32_t>(-Wide{a}));
  RC_ASSERT(saturate16(a) == saturated<std::int16_t>(a));
  RC_ASSERT(magnitude(a) == static_cast<std::uint32_t>(a < 0 ? -std::int64_t{a} : std::int64_t{a}));
  const Length x = Length::from_raw(a);
  const Length y = Length::from_raw(b);
  RC_ASSERT((x + y).raw() == saturating_add(a, b));
  RC_ASSERT((x - y).raw() == saturating_subtract(a, b));
  RC_ASSERT(abs(x).raw() == saturated<std::int32_t>(a < 0 ? -Wide{a} : Wide{a}));
}

RC_GTEST_PROP(Arithmetic, QuotientsRoundToNearestTiesAwayFromZero, ()) {
  const std::int64_t n = *edgy<std::int64_t>() / 2;
  const std::int32_t d = positive32();
  RC_ASSERT(divide_rounded(n, d) == rounded(n, d));
  RC_ASSERT(divide_rounded(-n, d) == -divide_rounded(n, d));
  RC_ASSERT(scale_down<30>(n) == rounded(n, Wide{1} << 30));
  RC_ASSERT(scale_down<1>(n) == rounded(n, 2));
  RC_ASSERT(scale_down<61>(n) == rounded(n, Wide{1} << 61));
  const std::int32_t small = edge32() / 2;
  RC_ASSERT(scale_down<4>(small) == rounded(small, 16));
  RC_ASSERT(scale_down<29>(small) == rounded(small, Wide{1} << 29));
  const std::int32_t a = edge32();
  const std::int32_t b = edge32();
  RC_ASSERT(multiply_divide(a, b, d) == saturated<std::int32_t>(rounded(Wide{a} * b, d)));
  RC_ASSERT((Length::from_raw(a) / d).raw() == rounded(a, d));
}

template <class F, class Rep>
void check_fixed(Rep a, Rep b, int fraction) {
  const F x = F::from_raw(a);
  const F y = F::from_raw(b);
  RC_ASSERT((x + y).raw() == saturated<Rep>(Wide{a} + b));
  RC_ASSERT((x - y).raw() == saturated<Rep>(Wide{a} - b));
  RC_ASSERT((-x).raw() == saturated<Rep>(-Wide{a}));
  RC_ASSERT((x * y).raw() == saturated<Rep>(rounded(Wide{a} * b, Wide{1} << fraction)));
  RC_ASSERT((x < y) == (a < b));
  RC_ASSERT((x > y) == (a > b));
  RC_ASSERT((x <= y) == (a <= b));
  RC_ASSERT((x >= y) == (a >= b));
  RC_ASSERT((x == y) == (a == b));
  RC_ASSERT((x != y) == (a != b));
}

RC_GTEST_PROP(Arithmetic, FixedPointNumbersAreTheRoundedSaturatedRationals, ()) {
  const std::int16_t a = *edgy<std::int16_t>();
  const std::int16_t b = *edgy<std::int16_t>();
  check_fixed<Q7>(a, b, 7);
  check_fixed<Q14>(a, b, 14);
  check_fixed<Q15>(a, b, 15);
  check_fixed<Q30>(edge32(), edge32(), 30);
  const std::int32_t n = edge32();
  const std::int32_t d = positive32();
  RC_ASSERT(Q14::ratio(n, d).raw() == saturated<std::int16_t>(rounded(Wide{n} * (1 << 14), d)));
  RC_ASSERT(Q30::ratio(n, d).raw() == saturated<std::int32_t>(rounded(Wide{n} * (1 << 30), d)));
}

RC_GTEST_PROP(Arithmetic, ProductsOfUnitsAreTheRoundedSaturatedOnes, ()) {
  const std::int32_t a = edge32();
  const std::int32_t b = edge32();
  const auto over = [&](std::int64_t d) { return saturated<std::int32_t>(rounded(Wide{a} * b, d)); };
  RC_ASSERT((Speed::from_raw(a) * milliseconds(b)).raw() == over(1000));
  RC_ASSERT((Acceleration::from_raw(a) * milliseconds(b)).raw() == over(1000));
  RC_ASSERT((AngularRate::from_raw(a) * Length::from_raw(b)).raw() == over(1000000));
  RC_ASSERT((Length::from_raw(a) * Q30::from_raw(b)).raw() == over(std::int64_t{1} << 30));
  RC_ASSERT((Length::from_raw(a) * b).raw() == over(1));
}

RC_GTEST_PROP(Arithmetic, AnglesWrapAndTheirArcsAgreeWithReals, ()) {
  const Angle a = Angle::from_raw(*edgy<std::uint32_t>());
  RC_ASSERT(Angle::from_raw(static_cast<std::uint32_t>(a.wrapped())) == a);
  RC_ASSERT(a + (-a) == Angle{});
  RC_ASSERT(magnitude(a) == magnitude(-a));
  const std::int32_t n = *rc::gen::inRange(-(1 << 30) + 1, 1 << 30);
  const std::int32_t d = positive32();
  RC_ASSERT(Angle::turns(n, d).raw() == static_cast<std::uint32_t>(rounded(Wide{n} * (Wide{1} << 32), d)));

  const Length radius = Length::from_raw(*rc::gen::inRange(-600000000, 600000001));
  const long double exact = std::ldexp(6.283185307179586476925L * a.wrapped(), -32) * radius.raw();
  const long double kept = std::fmin(std::fmax(exact, INT32_MIN), INT32_MAX);
  RC_ASSERT(std::fabs(arc(a, radius).raw() - kept) <= 2.0L);
  const Q14 k = Q14::from_raw(*edgy<std::int16_t>());
  const Angle third = Angle::from_raw(static_cast<std::uint32_t>(a.wrapped() / 3));
  const std::int64_t product = static_cast<std::int64_t>(rounded(Wide{third.wrapped()} * k.raw(), 1 << 14));
  RC_ASSERT(scaled(third, k).raw() == static_cast<std::uint32_t>(static_cast<std::uint64_t>(product)));
  RC_ASSERT(scaled(-third, k) == -scaled(third, k));
}

RC_GTEST_PROP(Arithmetic, RootsAndNormsAreFloors, ()) {
  const std::uint64_t x = *edgy<std::uint64_t>();
  const Wide r = square_root(x);
  RC_ASSERT(r * r <= Wide{x});
  RC_ASSERT((r + 1) * (r + 1) > Wide{x});
  const Vec v{Length::from_raw(edge32()), Length::from_raw(edge32())};
  const Wide square = Wide{v.x.raw()} * v.x.raw() + Wide{v.y.raw()} * v.y.raw();
  const Wide n = norm(v).raw();
  RC_ASSERT(n * n <= square);
  RC_ASSERT(n == INT32_MAX || (n + 1) * (n + 1) > square);
}

RC_GTEST_PROP(Arithmetic, DirectionsAreSymmetric, ()) {
  const Angle a = Angle::from_raw(*edgy<std::uint32_t>());
  RC_ASSERT(sin(-a) == -sin(a));
  RC_ASSERT(cos(-a) == cos(a));
  const std::int32_t y = *rc::gen::suchThat(edgy<std::int32_t>(), [](std::int32_t v) { return v > 0; });
  const std::int32_t x = edge32();
  RC_ASSERT(atan2(-y, x) == -atan2(y, x));
  const Vec v{Length::from_raw(edge32() / 2), Length::from_raw(edge32() / 2)};
  RC_ASSERT(along({v.x, -v.y}, -a) == along(v, a));
  const Vec p = polar(a, v.x);
  const Vec mirrored = polar(-a, v.x);
  RC_ASSERT(mirrored.x == p.x && mirrored.y == -p.y);
}

}  // namespace
}  // namespace whisker
