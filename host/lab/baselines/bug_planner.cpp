#include "host/lab/baselines/bug_planner.hpp"

#include "firmware/planning/steering.hpp"

namespace whisker::baselines {

using planning::Mode;
using planning::Outcome;
using planning::View;
using planning::Way;
using planning::Why;

void BugPlanner::start(const View& view) noexcept {
  target_ = {goal_, view};
  behaviours_.progress.start(view);
  follower_.reset(view);
  loop_.begin(view, behaviours_.params);
  survey_.reset();
  looked_mm_ = 0;
  rule_.begin(view, target_);
  enter(Phase::survey, Mode::surveying, Why::goal_set);
  advance(view);
}

void BugPlanner::advance(const View& view) noexcept {
  target_ = {goal_, view};
  behaviours_.progress.move(view, behaviours_.params);
  follower_.move(view);
  loop_.move(view);
  act(view);
}

void BugPlanner::act(const View& view) {
  const Why exhausted = behaviours_.progress.exhausted(kLongest);
  if (exhausted != Why::none) {
    finish(Mode::gave_up, exhausted, Outcome::gave_up);
    return;
  }
  if (phase_ != Phase::arrive && arrives(target_.to, target_.distance, view, behaviours_.params)) {
    phase_ = Phase::arrive;
    decision_.manoeuvre = planning::stop();
    return;
  }
  switch (phase_) {
    case Phase::survey:
      if (survey_.step(view, target_.direction(), behaviours_.params, decision_.manoeuvre))
        enter(Phase::go, Mode::going, Why::target_free);
      break;
    case Phase::go: go(view); break;
    case Phase::look_ahead:
    case Phase::look_away: look(view); break;
    case Phase::follow: follow(view); break;
    case Phase::arrive: arrive(view); break;
  }
}

void BugPlanner::arrive(const View& view) {
  if (!view.settled) return;
  if (target_.distance <= goal_.tolerance) {
    finish(Mode::arrived, Why::at_goal, Outcome::reached);
  } else {
    enter(Phase::go, Mode::going, Why::target_free);
  }
}

void BugPlanner::go(const View& view) {
  const Reach& reach = view.local_grid->reach();
  if (view.sighted) {
    course_ = rule_.course(view, target_);
    const Length ahead = min(reach.probe, target_.distance);
    if (planning::way(view, course_, ahead, reach.planning) == Way::occupied) {
      begin_follow(view);
      return;
    }
  }
  if (behaviours_.stalled(view)) {
    scan(view, Phase::look_ahead);
    return;
  }
  decision_.manoeuvre = behaviours_.drive(view, course_);
}

void BugPlanner::scan(const View& view, Phase phase) {
  const Length ahead = min(view.local_grid->reach().probe, target_.distance);
  enter(phase, Mode::looking, Why::unknown_ahead);
  behaviours_.scan.begin(rule_.course(view, target_), ahead, decision_.manoeuvre);
}

void BugPlanner::look(const View& view) {
  if (!behaviours_.scan.step(view, behaviours_.params, decision_.manoeuvre)) return;
  decision_.looked = true;
  if (phase_ == Phase::look_away) {
    if (leave(view)) return;
    enter(Phase::follow, Mode::following, Why::edge);
    follower_.begin_at_wall(view, follow_heading_, wall_, decision_);
  } else if (behaviours_.scan.in_vain()) {
    begin_follow(view);
  } else {
    enter(Phase::go, Mode::going, Why::target_free);
  }
}

void BugPlanner::begin_follow(const View& view) {
  wall_ = rule_.hit(view, target_);
  loop_.begin(view, behaviours_.params);
  enter(Phase::follow, Mode::searching, Why::target_blocked);
  follower_.begin_beside(view, course_, wall_, decision_);
}

Way BugPlanner::way_off(const View& view) const {
  const Length length = min(rule_.free_to_leave(view), target_.distance);
  return planning::way(view, rule_.course(view, target_), length, view.local_grid->reach().planning);
}

bool BugPlanner::leave(const View& view) {
  const Way found = way_off(view);
  if (found == Way::occupied) return false;
  if (found == Way::unknown && seen_free(view, target_, behaviours_.params) < view.local_grid->reach().probe)
    return false;
  enter(Phase::go, Mode::going, Why::target_free);
  go(view);
  return true;
}

bool BugPlanner::looks_away(const View& view) {
  if (behaviours_.progress.travel_mm() - looked_mm_ <= 50 || way_off(view) != Way::unknown) return false;
  looked_mm_ = behaviours_.progress.travel_mm();
  follow_heading_ = view.pose.heading;
  scan(view, Phase::look_away);
  return true;
}

bool BugPlanner::loop_ends(const View& view) {
  if (!rule_.remembers_hit() || !loop_.closed(view)) return false;
  finish(Mode::unreachable, Why::came_round, Outcome::unreachable);
  return true;
}

void BugPlanner::follow(const View& view) {
  if (view.sighted && follower_.follows()) {
    if (loop_ends(view)) return;
    if (rule_.may_leave(view, target_) && (leave(view) || looks_away(view))) return;
    if (loop_.strays(view)) {
      rule_.begin(view, target_);
      enter(Phase::go, Mode::going, Why::wall_lost);
      return;
    }
  }
  if (!follower_.step(view, decision_)) finish(Mode::gave_up, Why::no_exit, Outcome::gave_up);
}

void BugPlanner::enter(Phase phase, Mode mode, Why why) {
  phase_ = phase;
  behaviours_.enter();
  report(mode, why);
}

}  // namespace whisker::baselines
