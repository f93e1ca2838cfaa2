/// An object that moves.
#pragma once

#include "firmware/math/vec.hpp"

namespace whisker::perception {

/// Chips without the flash for Evasion leave it out: they stop before what moves, and stay.
#ifdef WHISKER_EVASION
constexpr bool kEvades = WHISKER_EVASION != 0;
#else
constexpr bool kEvades = true;
#endif

struct Mover {
  Vec at;             ///< its nearest point
  Angle direction;    ///< of its motion, by the scans that showed it before; towards the body if none did
  bool seen = false;  ///< at this tick
};

}  // namespace whisker::perception
