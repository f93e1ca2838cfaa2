/// The region in which robots and goals may be.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"

namespace whisker {

/// Limit of goals and placements, along each axis from the origin.
constexpr Length kPlaceLimit = millimetres(1000000);
/// Limit of the body, which may have to drive around an obstacle. The difference of two such coordinates fits
/// a Length; a distance above 2,147 m saturates.
constexpr Length kBodyLimit = millimetres(1050000);

/// farthest >= 0.
constexpr bool within(Length x, Length farthest) noexcept {
  const uint32_t limit = static_cast<uint32_t>(farthest.raw());
  return static_cast<uint32_t>(x.raw()) + limit <= 2 * limit;
}
constexpr bool within(Vec at, Length farthest) noexcept {
  return within(at.x, farthest) && within(at.y, farthest);
}
static_assert(within(-kPlaceLimit, kPlaceLimit) && !within(kPlaceLimit + micrometres(1), kPlaceLimit));
static_assert(!within(Length::from_raw(INT32_MIN), kPlaceLimit));

}  // namespace whisker
