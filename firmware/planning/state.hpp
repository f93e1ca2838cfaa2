/// Activity and reason of the navigation, as in the trace, the pictures and on the bus.
#pragma once

#include <stdint.h>

namespace whisker::planning {

/// The robot's activity in this tick.
enum class Mode : uint8_t {
  idle,         ///< no goal
  facing,       ///< turning to the target direction
  looking,      ///< standing until every beam has a steady reading
  steering,     ///< turning to the heading of the response table
  probing,      ///< deflecting by delta to find a heading on which the step is safe
  stepping,     ///< driving a step in free space
  searching,    ///< danger area: searching for an exit on both sides
  following,    ///< danger area: driving a small step along the obstacle's boundary
  surveying,    ///< turning to both sides before the first movement
  going,        ///< driving towards the goal by the response table
  arrived,      ///< at the goal, standing
  unreachable,  ///< closed the loop around the obstacle, standing
  gave_up,      ///< a budget is used up, standing
  stopped,      ///< safe stop after a fault, standing
};
constexpr int kModes = 14;

/// Reason for the activity.
enum class Why : uint8_t {
  none,
  goal_set,         ///< a new goal
  target_free,      ///< nothing near in the target direction: straight ahead
  table,            ///< the response table turned the step away from the target direction
  narrow,           ///< the planned step is not free: deflected by delta
  target_blocked,   ///< an obstacle in the target direction within the danger range
  exit_left,        ///< the exit on the left needs the smaller turn
  exit_right,       ///< the exit on the right needs the smaller turn
  same_side,        ///< the target stays blocked: deflecting to the same side as before
  blind,            ///< readings are lost: waiting
  unknown_ahead,    ///< unseen ground on the path: turning a beam onto it
  edge,             ///< along the obstacle's boundary
  opening,          ///< the boundary may have an opening: scanning
  way_back,         ///< no other path is free: retreating
  wall_lost,        ///< repeated laps around another obstacle: towards the goal again
  came_round,       ///< closed the loop around the obstacle
  something_moves,  ///< an object nearby moves: held by the guard, or searching a path around it
  at_goal,
  no_exit,        ///< no free heading in any direction
  step_budget,    ///< the maximum number of steps is used up
  length_budget,  ///< the maximum path length is used up
  cancelled,
  fault,                ///< see Health for its name
  goal_out_of_range,    ///< the goal is beyond kPlaceLimit: refused
  bumped,               ///< a bump switch was pressed: backing off
  gyro_rest,            ///< standing to measure the bias of the gyro
  tolerance_too_small,  ///< the goal's tolerance is below smallest_tolerance(): refused
};
constexpr int kWhys = 27;

const char* name(Mode mode) noexcept;
const char* name(Why why) noexcept;

}  // namespace whisker::planning
