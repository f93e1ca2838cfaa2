/// Points, displacements and poses in the plane.
#pragma once

#include "firmware/math/angle.hpp"
#include "firmware/math/units.hpp"

namespace whisker {

/// A point or a displacement.
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

}  // namespace whisker
