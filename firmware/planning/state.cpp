#include "firmware/planning/state.hpp"

namespace whisker::planning {

const char* name(Mode mode) noexcept {
  switch (mode) {
    case Mode::idle: return "idle";
    case Mode::facing: return "facing";
    case Mode::looking: return "looking";
    case Mode::steering: return "steering";
    case Mode::probing: return "probing";
    case Mode::stepping: return "stepping";
    case Mode::searching: return "searching";
    case Mode::following: return "skirting";
    case Mode::surveying: return "surveying";
    case Mode::going: return "going";
    case Mode::unreachable: return "unreachable";
    case Mode::arrived: return "arrived";
    case Mode::gave_up: return "gave_up";
    case Mode::stopped: return "stopped";
  }
  return "?";
}

const char* name(Why why) noexcept {
  switch (why) {
    case Why::none: return "none";
    case Why::goal_set: return "goal_set";
    case Why::target_free: return "target_free";
    case Why::table: return "table";
    case Why::narrow: return "narrow";
    case Why::target_blocked: return "target_blocked";
    case Why::exit_left: return "exit_left";
    case Why::exit_right: return "exit_right";
    case Why::same_side: return "same_side";
    case Why::blind: return "blind";
    case Why::unknown_ahead: return "unknown_ahead";
    case Why::edge: return "edge";
    case Why::opening: return "opening";
    case Why::way_back: return "way_back";
    case Why::wall_lost: return "wall_lost";
    case Why::came_round: return "came_round";
    case Why::something_moves: return "something_moves";
    case Why::at_goal: return "at_goal";
    case Why::no_exit: return "no_exit";
    case Why::step_budget: return "step_budget";
    case Why::length_budget: return "length_budget";
    case Why::cancelled: return "cancelled";
    case Why::fault: return "fault";
    case Why::goal_out_of_range: return "goal_out_of_range";
    case Why::bumped: return "bumped";
    case Why::gyro_rest: return "gyro_rest";
    case Why::tolerance_too_small: return "tolerance_too_small";
  }
  return "?";
}

}  // namespace whisker::planning
