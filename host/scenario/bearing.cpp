#include "host/scenario/bearing.hpp"

#include "host/sim/elementary.hpp"

namespace whisker {

double bearing(sim::Vec2 from, sim::Vec2 to) { return sim::arc_tangent(to.y - from.y, to.x - from.x); }

}  // namespace whisker
