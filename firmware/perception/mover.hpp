/// An object that moves.
#pragma once

#include "firmware/math/vec.hpp"

namespace whisker::perception {

struct Mover {
  Vec at;             ///< its nearest point
  Length distance;    ///< of it from the beam that sees it
  Angle direction;    ///< of its motion, by the scans that showed it before; towards the body if none did
  bool seen = false;  ///< at this tick
};

}  // namespace whisker::perception
