#include "host/report/track.hpp"

namespace whisker::report {
namespace {

Doing doing_of_step(nav::Why why) noexcept {
  switch (why) {
    case nav::Why::table: return Doing::table;
    case nav::Why::narrow: return Doing::probing;
    case nav::Why::target_blocked:
    case nav::Why::exit_left:
    case nav::Why::exit_right:
    case nav::Why::edge:
    case nav::Why::opening:
    case nav::Why::way_back:
    case nav::Why::same_side: return Doing::danger;
    case nav::Why::none:
    case nav::Why::goal_set:
    case nav::Why::target_free:
    case nav::Why::blind:
    case nav::Why::at_goal:
    case nav::Why::no_exit:
    case nav::Why::step_budget:
    case nav::Why::unknown_ahead:
    case nav::Why::came_round:
    case nav::Why::something_moves:
    case nav::Why::wall_lost:
    case nav::Why::length_budget:
    case nav::Why::cancelled:
    case nav::Why::goal_out_of_range:
    case nav::Why::fault: return Doing::free;
  }
  return Doing::free;
}

}  // namespace

Doing doing(const TickRecord& record) noexcept {
  if (record.danger_count > 0) return Doing::danger;
  switch (record.mode) {
    case nav::Mode::steering: return Doing::table;
    case nav::Mode::probing: return Doing::probing;
    case nav::Mode::searching:
    case nav::Mode::skirting: return Doing::danger;
    case nav::Mode::going:
    case nav::Mode::stepping: return doing_of_step(record.why);
    case nav::Mode::idle:
    case nav::Mode::facing:
    case nav::Mode::looking:
    case nav::Mode::surveying:
    case nav::Mode::unreachable:
    case nav::Mode::arrived:
    case nav::Mode::gave_up:
    case nav::Mode::stopped: return Doing::free;
  }
  return Doing::free;
}

}  // namespace whisker::report
