/// Drives for an adversary: they begin beside an obstacle.
#pragma once

#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/random.hpp"

namespace whisker::worlds {

struct Class {
  Kind kind;
  int discs;  ///< 0: the kind has none
  bool box;
};
constexpr Class kClasses[] = {{Kind::discs, 15, false},  {Kind::discs, 30, false}, {Kind::discs, 50, false},
                              {Kind::discs, 75, true},   {Kind::u_trap, 0, false}, {Kind::spiral, 0, false},
                              {Kind::maze, 0, false},    {Kind::rooms, 0, false},  {Kind::poles, 0, false},
                              {Kind::enclosed, 0, false}};
/// Some of kClasses.
struct Classes {
  const Class* first;
  int count;
};
constexpr Classes kAllClasses{kClasses, 10};
constexpr Classes kCrowdedClasses{kClasses + 1, 9};  ///< all but that with 15 discs

/// A world of one of these classes and of the robot's size. The body stands at most 0.3 m (for a radius of
/// 90 mm) from an obstacle, if 200 draws find such a place, on ground that rim_sweep() takes as free, with
/// any heading.
Scenario beside_obstacle(Random& random, Classes classes, bool noise, const Params& robot);

}  // namespace whisker::worlds
