#include "host/baselines/walker.hpp"

#include "firmware/planning/steering.hpp"

namespace whisker::baselines {
namespace {

constexpr std::int64_t kTurn = INT64_C(1) << 32;

std::int64_t size(std::int64_t x) { return x < 0 ? -x : x; }

}  // namespace

void Walker::start(const planning::View& view) noexcept {
  last_ = view.pose;
  travel_um_ = 0;
  surveyed_left_ = false;
  edge_.forget_trail(view);
  account(view);
  begin(view);
  enter(Phase::survey, planning::Mode::surveying, planning::Why::goal_set);
  advance(view);
}

void Walker::advance(const planning::View& view) noexcept {
  account(view);
  act(view);
}

void Walker::account(const planning::View& view) {
  travel_um_ += norm(view.pose.at - last_.at).raw();
  turned_ += (view.pose.heading - last_.heading).wrapped();
  last_ = view.pose;
  to_goal_ = goal_.at - view.pose.at;
  distance_ = norm(to_goal_);
  edge_.note(view);
}

void Walker::act(const planning::View& view) {
  if (travel_um_ > std::int64_t{kLongest.raw()}) {
    finish(planning::Mode::gave_up, planning::Why::length_budget, planning::Outcome::gave_up);
    return;
  }
  if (phase_ != Phase::halt && is_goal(distance_)) {
    phase_ = Phase::halt;
    decision_.manoeuvre = planning::stop();
    return;
  }
  switch (phase_) {
    case Phase::halt:
      if (!view.settled) break;
      if (distance_ <= goal_.tolerance) {
        finish(planning::Mode::arrived, planning::Why::at_goal, planning::Outcome::reached);
      } else {
        enter(Phase::go, planning::Mode::going, planning::Why::target_free);
      }
      break;
    case Phase::survey: survey(view); break;
    case Phase::go: go(view); break;
    case Phase::look_ahead:
    case Phase::look_away: look(view); break;
    case Phase::follow: follow(view); break;
  }
}

void Walker::survey(const planning::View& view) {
  const Angle heading = bearing(to_goal_) + (surveyed_left_ ? -50_deg : 50_deg);
  if (!planning::turn_by(heading - view.pose.heading, params_, decision_.manoeuvre)) return;
  if (surveyed_left_) enter(Phase::go, planning::Mode::going, planning::Why::target_free);
  surveyed_left_ = true;
}

void Walker::go(const planning::View& view) {
  const Reach& reach = view.local_grid->reach();
  if (view.sighted) {
    course_ = course(view);
    if (planning::way(view, course_, min(reach.probe, distance_), reach.planning) ==
        planning::Way::occupied) {
      begin_follow(view);
      return;
    }
  }
  if (stuck_.stalled(view, EdgeWalk::kPatience, params_)) {
    scan_.begin(decision_.manoeuvre);
    enter(Phase::look_ahead, planning::Mode::looking, planning::Why::unknown_ahead);
    return;
  }
  decision_.manoeuvre =
      planning::cruise(planning::steer(course_ - view.pose.heading, params_.wheels.max_speed), params_);
}

void Walker::look(const planning::View& view) {
  const Length ahead = min(view.local_grid->reach().probe, distance_);
  if (!scan_.step(view, course(view), ahead, params_, decision_.manoeuvre)) return;
  decision_.looked = true;
  stuck_.reset();
  if (phase_ == Phase::look_ahead) {
    enter(Phase::go, planning::Mode::going, planning::Why::target_free);
  } else if (!leave(view)) {
    enter(Phase::follow, planning::Mode::skirting, planning::Why::edge);
    decision_.manoeuvre = planning::stop();
    edge_.resume(view, walk_heading_);
  }
}

void Walker::begin_follow(const planning::View& view) {
  hit_at_ = view.pose.at;
  on_its_way_ = false;
  edge_.begin(hit(view), course_);
  enter(Phase::follow, planning::Mode::searching, planning::Why::target_blocked);
  decision_.manoeuvre = planning::stop();
}

bool Walker::came_round(const planning::View& view) const {
  const Length length = Length::from_raw(saturate32(travel_um_ - mark_travel_um_));
  return size(turned_) > kTurn * 300 / 360 &&
         norm(view.pose.at - mark_.at) < min(300_mm, 100_mm + length / 100) &&
         magnitude(view.pose.heading - mark_.heading) < (60_deg).raw();
}

planning::Way Walker::way_off(const planning::View& view, Angle heading) const {
  return planning::way(view, heading, min(free_to_leave(view), distance_), view.local_grid->reach().planning);
}

bool Walker::leave(const planning::View& view) {
  const Angle heading = course(view);
  const planning::Way found = way_off(view, heading);
  if (found == planning::Way::occupied ||
      (found == planning::Way::unknown && seen_free(view) < view.local_grid->reach().probe))
    return false;
  stuck_.reset();
  enter(Phase::go, planning::Mode::going, planning::Why::target_free);
  go(view);
  return true;
}

void Walker::follow(const planning::View& view) {
  if (view.sighted && edge_.drives()) {
    if (!on_its_way_ && norm(view.pose.at - hit_at_) > 200_mm) {
      on_its_way_ = true;
      mark_ = view.pose;
      mark_travel_um_ = travel_um_;
      turned_ = 0;
    }
    if (on_its_way_ && can_tell_unreachable() && came_round(view)) {
      finish(planning::Mode::unreachable, planning::Why::came_round, planning::Outcome::unreachable);
      return;
    }
    if (may_leave(view)) {
      if (leave(view)) return;
      if (travel_um_ - looked_um_ > Length{50_mm}.raw() &&
          way_off(view, course(view)) == planning::Way::unknown) {
        looked_um_ = travel_um_;
        walk_heading_ = view.pose.heading;
        scan_.begin(decision_.manoeuvre);
        enter(Phase::look_away, planning::Mode::looking, planning::Why::unknown_ahead);
        return;
      }
    }
    // Twice round something that is not what it hit.
    if (on_its_way_ && size(turned_) > 2 * kTurn) {
      begin(view);
      enter(Phase::go, planning::Mode::going, planning::Why::wall_lost);
      return;
    }
  }
  if (!edge_.step(view, decision_))
    finish(planning::Mode::gave_up, planning::Why::no_exit, planning::Outcome::gave_up);
}

Length Walker::seen_free(const planning::View& view) const {
  const Angle target = bearing(to_goal_);
  Length free;
  for (int i = 0; i < hal::kBeams; ++i) {
    const perception::Echo& echo = view.moving_scan.beam[i];
    if (!perception::usable(echo.validity)) continue;
    const Angle axis = view.pose.heading + beam_axis(params_.rangefinders.side_angle, i);
    if (magnitude(axis - target) > (6_deg).raw()) continue;
    free = max(free, echo.distance - view.local_grid->reach().planning);
  }
  return free;
}

void Walker::enter(Phase phase, planning::Mode mode, planning::Why why) {
  phase_ = phase;
  tell(mode, why);
}

}  // namespace whisker::baselines
