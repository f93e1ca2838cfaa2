/// What the navigation does and why: the words of the trace, of the pictures and of the bus.
#pragma once

#include <stdint.h>

namespace whisker::planning {

/// What the robot is doing at this tick.
enum class Mode : uint8_t {
  idle,         ///< no goal
  facing,       ///< turning to the target direction
  looking,      ///< standing still until every beam has a trustworthy reading
  steering,     ///< turning to the heading that the response table asked for
  probing,      ///< deflecting by delta to find a heading on which the step is safe
  stepping,     ///< driving a step in free space
  searching,    ///< danger area: looking for an exit on both sides
  skirting,     ///< danger area: driving a small step along the obstacle's edge
  surveying,    ///< turning to both sides before the first movement
  going,        ///< driving towards the goal by the response table
  arrived,      ///< at the goal, standing
  unreachable,  ///< came round what is in the way, standing
  gave_up,      ///< a stated budget is used up, standing
  stopped,      ///< safe stop after a fault, standing
};
constexpr int kModes = 14;

/// Why it does that.
enum class Why : uint8_t {
  none,
  goal_set,         ///< a new goal
  target_free,      ///< nothing near in the target direction: straight on
  table,            ///< the response table turned the step away from the target direction
  narrow,           ///< the planned step is not free: deflected by delta
  target_blocked,   ///< an obstacle in the target direction within the danger range
  exit_left,        ///< the exit on the left needs the smaller turn
  exit_right,       ///< the exit on the right needs the smaller turn
  same_side,        ///< the target stays blocked: deflecting to the side chosen before
  blind,            ///< readings are lost: waiting
  unknown_ahead,    ///< something in the way was never seen: turning a beam onto it
  edge,             ///< along the obstacle's edge
  opening,          ///< the edge may have an opening: looking
  way_back,         ///< no other way is free: back where it came from
  wall_lost,        ///< twice round something else than what it met: towards the goal again
  came_round,       ///< back where the obstacle was met, all the way around it
  something_moves,  ///< something nearby moves: held back, or looking for a way around
  at_goal,
  no_exit,        ///< no free heading all around
  step_budget,    ///< the number of steps is used up
  length_budget,  ///< the length is used up
  cancelled,
  fault,              ///< see Health for its name
  goal_out_of_range,  ///< the goal lies farther out than kPlaceLimit: refused
};
constexpr int kWhys = 24;

const char* name(Mode mode) noexcept;
const char* name(Why why) noexcept;

}  // namespace whisker::planning
