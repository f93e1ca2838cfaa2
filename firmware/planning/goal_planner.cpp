#include "firmware/planning/goal_planner.hpp"

#include "firmware/planning/steering.hpp"

namespace whisker::planning {
namespace {

constexpr int32_t kHardly = 8;  // part of the top speed

}  // namespace

bool GoalPlanner::arrives(const Vec& to, Length distance, const View& view,
                          const Params& params) const noexcept {
  if (!is_goal(distance)) return false;
  if (view.forward < params.wheels.max_speed / kHardly) return true;
  const Duration delay = params.wheels.motor_lag + params.safety.period;
  return view.forward >= stopping_speed(along(to, view.pose.heading), delay, params);
}

const Decision& GoalPlanner::answer(const View& view) noexcept {
  decision_.manoeuvre = {};
  decision_.looked = false;
  decision_.lane.opens = false;
  const Request request = request_;
  request_ = Request::none;
  if (view.local_grid != nullptr) view.local_grid->work().begin_searches();
  switch (request) {
    case Request::none:
      if (decision_.outcome == Outcome::running) advance(view);
      break;
    case Request::goal:
      decision_ = Decision{};
      decision_.outcome = Outcome::running;
      start(view);
      break;
    case Request::cancel: finish(Mode::idle, Why::cancelled, Outcome::none); break;
  }
  return decision_;
}

void GoalPlanner::report(Mode mode, Why why) noexcept {
  decision_.mode = mode;
  decision_.why = why;
}

void GoalPlanner::finish(Mode mode, Why why, Outcome outcome) noexcept {
  report(mode, why);
  decision_.outcome = outcome;
  decision_.danger_count = 0;
  decision_.manoeuvre = stop();
}

}  // namespace whisker::planning
