/// Trigonometry and roots in integers. The errors are maxima over the whole domain, measured and asserted by
/// tests/math.
///
/// All functions work in constant expressions. At run time they call trig.cpp, so that a target contains each
/// function once.
#pragma once

#include <stdint.h>

#include "firmware/math/angle.hpp"
#include "firmware/math/fixed.hpp"
#include "firmware/math/units.hpp"
#include "firmware/math/vec.hpp"

namespace whisker {

/// Sine. Error at most 6e-9. Exact at multiples of a quarter turn; sin(-a) == -sin(a).
constexpr Q30 sin(Angle a) noexcept;
constexpr Q30 cos(Angle a) noexcept;

/// The direction of (x, y), whatever their common unit; 0 for (0, 0). Error at most 1.2e-8 rad. Exact on the
/// axes; atan2(-y, x) == -atan2(y, x).
constexpr Angle atan2(int32_t y, int32_t x) noexcept;
constexpr Angle bearing(const Vec& v) noexcept;

/// The largest r with r * r <= x.
constexpr uint32_t square_root(uint64_t x) noexcept;
constexpr uint32_t square_root_32(uint32_t x) noexcept;

/// Rounded down; saturates. Error below 1 um.
constexpr Length norm(const Vec& v) noexcept;

/// norm(v) > length, without the root. True for every negative length.
constexpr bool farther(const Vec& v, Length length) noexcept;

/// The displacement of this length in this direction; each coordinate rounded to nearest.
constexpr Vec polar(Angle direction, Length length) noexcept;

/// The component of v in this direction.
constexpr Length along(const Vec& v, Angle direction) noexcept;

/// A direction by its sines, for those who ask more than once.
struct Facing {
  Q30 cos = Q30::from_raw(Q30::kOne);
  Q30 sin;
};
constexpr Facing facing(Angle direction) noexcept;
constexpr Vec polar(Facing direction, Length length) noexcept;
constexpr Length along(const Vec& v, Facing direction) noexcept;

/// The component of v to the right of this direction: how far a line in this direction through the point v
/// passes to the left of the origin, with the opposite sign.
constexpr Length across(const Vec& v, Facing direction) noexcept {
  return v.x * direction.sin - v.y * direction.cos;
}
constexpr Length across(const Vec& v, Angle direction) noexcept;

/// The angle whose sine is part / whole; |part| <= whole.
constexpr Angle arc_sine(Length part, Length whole) noexcept {
  const int64_t rest = int64_t{whole.raw()} * whole.raw() - int64_t{part.raw()} * part.raw();
  return atan2(part.raw(), saturate32(square_root(static_cast<uint64_t>(rest))));
}

}  // namespace whisker

#include "firmware/math/trig_math.hpp"
