/// The core's quantities as numbers for pictures and files.
#pragma once

#include "firmware/math/angle.hpp"
#include "firmware/math/units.hpp"

namespace whisker::report {

constexpr double metres(Length length) { return static_cast<double>(length.raw()) / 1e6; }

/// In [-pi, pi).
constexpr double radians(Angle angle) {
  return static_cast<double>(angle.wrapped()) / 4294967296.0 * 6.283185307179586;
}

/// In [-180, 180).
constexpr double degrees(Angle angle) { return static_cast<double>(angle.wrapped()) * (360 / 4294967296.0); }

}  // namespace whisker::report
