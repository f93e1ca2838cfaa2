/// The manoeuvres that a planner asks for, and the velocities that follow from them.
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
  cruise,  ///< run at these speeds until told otherwise
};

struct Manoeuvre {
  ManoeuvreKind kind = ManoeuvreKind::keep;
  Angle heading{};
  Length length{};
  Speed forward{};  ///< of a cruise
  Speed turning{};  ///< of a cruise: the rims' speed of turning, counter-clockwise positive
};

constexpr Manoeuvre stop() noexcept { return {ManoeuvreKind::stop, {}, {}, {}, {}}; }

/// The velocities of one tick that a manoeuvre asks for. The guard decides what is granted of them.
struct VelocityRequest {
  Speed forward{};
  Speed turning{};     ///< of the rims, counter-clockwise positive
  bool moves = false;  ///< false: stand, or brake until the body stands
};

}  // namespace whisker::planning
