/// Trigonometry and roots in integers. Errors are the largest over the whole domain, measured and
/// asserted by tests/core.
#pragma once

#include <stdint.h>

#include "firmware/core/angle.hpp"
#include "firmware/core/fixed.hpp"
#include "firmware/core/units.hpp"

namespace whisker {

/// Sine. Off by at most 6e-9. Exact at multiples of a quarter turn; sin(-a) == -sin(a).
Q30 sin(Angle a) noexcept;
inline Q30 cos(Angle a) noexcept { return sin(Angle::turns(1, 4) - a); }

/// The direction of (x, y), whatever their common unit; 0 for (0, 0). Off by at most 1.2e-8 rad.
/// Exact on the axes; atan2(-y, x) == -atan2(y, x).
Angle atan2(int32_t y, int32_t x) noexcept;

/// The largest r with r * r <= x.
uint32_t square_root(uint64_t x) noexcept;
uint32_t square_root_32(uint32_t x) noexcept;

/// A point or a displacement in the plane.
struct Vec {
  Length x;
  Length y;
  friend constexpr Vec operator+(Vec a, Vec b) noexcept { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec operator-(Vec a, Vec b) noexcept { return {a.x - b.x, a.y - b.y}; }
  friend constexpr bool operator==(Vec a, Vec b) noexcept { return a.x == b.x && a.y == b.y; }
};

struct Pose {
  Vec at;
  Angle heading;
};

inline Angle bearing(Vec v) noexcept { return atan2(v.y.raw(), v.x.raw()); }

/// Rounded down; saturates. Off by less than 1 um.
Length norm(Vec v) noexcept;

/// norm(v) > length, without the root. Nothing is nearer than a negative length.
bool farther(Vec v, Length length) noexcept;

/// The displacement of this length in this direction; each coordinate to nearest.
Vec polar(Angle direction, Length length) noexcept;

/// How far v reaches in this direction.
Length along(Vec v, Angle direction) noexcept;

}  // namespace whisker
