/// What navigation asks of motion: one of these at a time.
#pragma once

#include <stdint.h>

#include "firmware/core/angle.hpp"
#include "firmware/core/units.hpp"

namespace whisker::nav {

enum class Kind : uint8_t {
  keep,    ///< go on with the one under way
  stop,    ///< come to rest as fast as the acceleration limit allows, and stand
  turn,    ///< turn on the spot to `heading`, the shorter way
  drive,   ///< drive `length` straight along `heading`, and stand
  cruise,  ///< run at these speeds until told otherwise, as far as the shield lets it
};

struct Manoeuvre {
  Kind kind = Kind::keep;
  Angle heading{};
  Length length{};
  Speed forward{};  ///< of a cruise
  Speed turning{};  ///< of a cruise: the rims' speed of turning, counter-clockwise positive
};

constexpr Manoeuvre stop() noexcept { return {Kind::stop, {}, {}, {}, {}}; }

}  // namespace whisker::nav
