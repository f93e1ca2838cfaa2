/// Fresh cases from one number each, and changed ones.
#pragma once

#include <cstdint>

#include "host/lab/hunt/case.hpp"
#include "host/lab/hunt/robots.hpp"
#include "host/lab/hunt/worlds.hpp"

namespace whisker::hunt {

struct Drawn {
  Case c;  ///< holds_premise()
  DrawnRobot robot;
  World world = World::scatter;
};

/// A drive. The same seed gives the same case on every machine.
Drawn draw_case(std::uint64_t seed);
/// Every fourth seed gives draw_case(), the others a part of the core, the parts in turn: they cost little.
Drawn draw_fresh(std::uint64_t seed);

/// A few changes of robot, world, commands, goal or gaps that keep the premise; the case itself if none does.
Case changed(const Case& c, std::uint64_t seed);

}  // namespace whisker::hunt
