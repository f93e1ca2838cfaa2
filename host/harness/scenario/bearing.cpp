#include "host/harness/scenario/bearing.hpp"

#include "host/harness/sim/elementary.hpp"

namespace whisker {

double bearing(sim::Vec2 from, sim::Vec2 to) { return sim::arc_tangent(to.y - from.y, to.x - from.x); }

}  // namespace whisker
