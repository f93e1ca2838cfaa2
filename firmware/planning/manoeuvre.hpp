/// What navigation asks of motion: one of these at a time.
#pragma once

#include <stdint.h>

#include "firmware/math/angle.hpp"
#include "firmware/math/units.hpp"

namespace whisker::planning {

enum class ManoeuvreKind : uint8_t {
  keep,    ///< go on with the one under way
  stop,    ///< come to rest as fast as the acceleration limit allows, and stand
  turn,    ///< turn on the spot to `heading`, the shorter way
  drive,   ///< drive `length` straight along `heading`, and stand
  cruise,  ///< run at these speeds until told otherwise, as far as the guard lets it
};

struct Manoeuvre {
  ManoeuvreKind kind = ManoeuvreKind::keep;
  Angle heading{};
  Length length{};
  Speed forward{};  ///< of a cruise
  Speed turning{};  ///< of a cruise: the rims' speed of turning, counter-clockwise positive
  /// Of a cruise: back over ground that the body has just stood on.
  bool retraces = false;
};

constexpr Manoeuvre stop() noexcept { return {ManoeuvreKind::stop, {}, {}, {}, {}, false}; }

}  // namespace whisker::planning
