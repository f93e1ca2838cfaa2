/// The manoeuvres that a planner requests, and the resulting velocities.
#pragma once

#include <stdint.h>

#include "firmware/math/angle.hpp"
#include "firmware/math/units.hpp"

namespace whisker::planning {

enum class ManoeuvreKind : uint8_t {
  keep,    ///< continue the current one
  stop,    ///< come to rest at the acceleration limit, and stand
  turn,    ///< turn on the spot to `heading`, in the shorter direction
  drive,   ///< drive `length` straight along `heading`, and stand
  cruise,  ///< drive at these speeds until the next manoeuvre
};

struct Manoeuvre {
  ManoeuvreKind kind = ManoeuvreKind::keep;
  Angle heading{};
  Length length{};
  Speed forward{};  ///< of a cruise
  Speed turning{};  ///< of a cruise: the rims' speed of turning, counter-clockwise positive
};

constexpr Manoeuvre stop() noexcept { return {ManoeuvreKind::stop, {}, {}, {}, {}}; }

/// The velocities that a manoeuvre requests in one tick. The guard decides how much it grants.
struct VelocityRequest {
  Speed forward{};
  Speed turning{};     ///< of the rims, counter-clockwise positive
  bool moves = false;  ///< false: stand, or brake until the body stands
};

}  // namespace whisker::planning
