#include "host/lab/report/track.hpp"

namespace whisker::report {
namespace {

Doing doing_of_step(planning::Why why) noexcept {
  switch (why) {
    case planning::Why::table: return Doing::table;
    case planning::Why::narrow: return Doing::probing;
    case planning::Why::target_blocked:
    case planning::Why::exit_left:
    case planning::Why::exit_right:
    case planning::Why::edge:
    case planning::Why::opening:
    case planning::Why::way_back:
    case planning::Why::same_side: return Doing::danger;
    case planning::Why::none:
    case planning::Why::goal_set:
    case planning::Why::target_free:
    case planning::Why::blind:
    case planning::Why::at_goal:
    case planning::Why::no_exit:
    case planning::Why::step_budget:
    case planning::Why::unknown_ahead:
    case planning::Why::came_round:
    case planning::Why::something_moves:
    case planning::Why::wall_lost:
    case planning::Why::length_budget:
    case planning::Why::cancelled:
    case planning::Why::goal_out_of_range:
    case planning::Why::bumped:
    case planning::Why::gyro_rest:
    case planning::Why::tolerance_too_small:
    case planning::Why::fault: return Doing::free;
  }
  return Doing::free;
}

}  // namespace

Doing doing(const TickRecord& record) noexcept {
  if (record.danger_count > 0) return Doing::danger;
  switch (record.mode) {
    case planning::Mode::steering: return Doing::table;
    case planning::Mode::probing: return Doing::probing;
    case planning::Mode::searching:
    case planning::Mode::following: return Doing::danger;
    case planning::Mode::going:
    case planning::Mode::stepping: return doing_of_step(record.why);
    case planning::Mode::idle:
    case planning::Mode::facing:
    case planning::Mode::looking:
    case planning::Mode::surveying:
    case planning::Mode::unreachable:
    case planning::Mode::arrived:
    case planning::Mode::gave_up:
    case planning::Mode::stopped: return Doing::free;
  }
  return Doing::free;
}

}  // namespace whisker::report
