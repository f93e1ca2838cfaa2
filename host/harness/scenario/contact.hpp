#pragma once

#include <string>

#include "host/harness/scenario/scenario.hpp"

namespace whisker {

struct Nearest {
  double distance_m = 0;  ///< from the point; negative inside a solid or beyond the bounds
  std::string what;       ///< "disc 2", "polygon 1", "wall 1", "mover 1", "the bounds"; empty: nothing
};

/// The obstacle nearest to a point at time 0. Infinitely far if the world is empty.
Nearest nearest_obstacle(const Scenario& scenario, sim::Vec2 point);

/// The reason why the robot cannot start at the start (it touches something there), empty if it can. Call it
/// again whenever the body radius changes.
std::string start_fault(const Scenario& scenario);
/// A warning if the start is nearer to an obstacle than the guard relies on (docs/safety.md); else empty.
std::string start_warning(const Scenario& scenario);

}  // namespace whisker
