/// Worlds that campaigns do not draw, in units of the body's radius.
#pragma once

#include "host/harness/scenario/scenario.hpp"
#include "host/lab/hunt/dice.hpp"

namespace whisker::hunt {

enum class World {
  scatter,  ///< a few obstacles of every form
  posts,    ///< of 1 mm
  needles,  ///< thin triangles
  walls,    ///< without thickness
  rings,    ///< around the start, closed or with a door
  combs,    ///< parallel teeth
  corners,  ///< acute, open towards the start
  pocket,   ///< the outer box is little larger than the body
  doors,    ///< as narrow as the planners promise to pass, or 1 % narrower
  crowd,    ///< up to 10,000 obstacles
  usual,    ///< those of the campaigns
};
constexpr int kWorlds = static_cast<int>(World::usual) + 1;
const char* name(World world);

/// Start, goal and obstacles around the scenario's robot. Nothing lies within free_at_start_m() of the start,
/// and something may lie just beyond.
World draw_world(Dice& dice, Scenario& scenario);
/// Moves, adds or removes obstacles, or turns the start.
void change_world(Dice& dice, Scenario& scenario);
/// Moves everything.
void shift(Scenario& scenario, sim::Vec2 by);

}  // namespace whisker::hunt
