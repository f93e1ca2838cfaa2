/// The side of the body on which an obstacle lies.
#pragma once

#include <stdint.h>

namespace whisker::planning {

enum class Side : int8_t { right = -1, left = 1 };

/// +1 for left: the sign of a turn to that side.
constexpr int32_t sign(Side s) noexcept { return s == Side::left ? 1 : -1; }
constexpr Side opposite(Side s) noexcept { return s == Side::left ? Side::right : Side::left; }

}  // namespace whisker::planning
