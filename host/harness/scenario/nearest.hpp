#pragma once

#include <cstddef>

#include "host/harness/scenario/scenario.hpp"

namespace whisker {

struct NearThing {
  double distance_m;   ///< from the point; negative inside a solid or beyond the bounds
  const char* kind;    ///< "disc", "polygon", "wall", "mover", "the bounds"; empty: nothing at all
  std::size_t number;  ///< counted from 1 among its kind; 0 for the bounds
};

/// The obstacle nearest to a point at time 0. Infinitely far if the world is empty.
NearThing near_thing(const Scenario& scenario, sim::Vec2 point);

/// The robot does not touch anything at its start.
bool start_is_free(const Scenario& scenario);

}  // namespace whisker
