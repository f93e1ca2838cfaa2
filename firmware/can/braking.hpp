/// How a base brakes the wheels while it has no command.
#pragma once

#include <stdint.h>

#include "firmware/math/fixed.hpp"
#include "hal/types.hpp"

namespace whisker::can {

constexpr int32_t size_of(int16_t speed) noexcept { return speed < 0 ? -int32_t{speed} : int32_t{speed}; }

/// The speeds of the next period: both wheels are scaled by the same factor, so that the path keeps its
/// curvature; the faster one loses `step`.
constexpr hal::WheelSpeeds slowed(hal::WheelSpeeds now, int16_t step) noexcept {
  const int32_t fastest = size_of(now.left) > size_of(now.right) ? size_of(now.left) : size_of(now.right);
  if (fastest <= step) return {};
  const auto rest = [&](int16_t speed) { return narrow<int16_t>(speed * (fastest - step) / fastest); };
  return {rest(now.left), rest(now.right)};
}

}  // namespace whisker::can
