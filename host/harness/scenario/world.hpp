#pragma once

#include <cstdint>
#include <vector>

#include "host/harness/scenario/scenario.hpp"

namespace whisker {

/// The obstacles of a scenario in the form of the simulator: discs and straight edges.
struct World {
  std::vector<sim::Disc> discs;
  std::vector<sim::Segment> segments;  ///< of the polygons, then the walls, then the bounds
  std::vector<Mover> movers;
  /// Not 0 for what absorbs: of the discs, then the movers, then the segments. Empty: nothing absorbs.
  std::vector<std::uint8_t> soft = {};
};

World make_world(const Scenario& scenario);

}  // namespace whisker
