#include "firmware/nav/skirt.hpp"

#include "firmware/nav/edge.hpp"

namespace whisker::nav {
namespace {

constexpr Angle kSurvey = 50_deg;  // with the cones' rims, 92 degrees to each side
constexpr Angle kFacing = 3_deg;
constexpr Length kProgress = 30_mm;
constexpr Length kLongest = 400_m;
constexpr Length kKeepSide = 500_mm;  // of travel after a leave
constexpr int8_t kEscapes = 6;
constexpr int8_t kRetreats = 8;

constexpr Angle kCheapTurn = 25_deg;
constexpr Q14 kHindered = Q14::ratio(9, 10);

constexpr Angle kFeelFrom = 110_deg;
constexpr Angle kNotBack = 45_deg;
constexpr Length kShortWay = 60_mm;
constexpr Length kCommit = 60_mm;
constexpr Length kOpeningEvery = 100_mm;
constexpr Length kOpeningWay = 100_mm;
constexpr int32_t kOpeningCells = 6;

/// A place counts as the goal only well inside the tolerance: the estimate has its own error.
Length close_enough(Length tolerance) noexcept { return tolerance - tolerance / 8; }

}  // namespace

void SkirtPlanner::set_goal(const Goal& goal) noexcept {
  goal_ = goal;
  request_ = Request::goal;
}

void SkirtPlanner::cancel() noexcept { request_ = Request::cancel; }

Decision SkirtPlanner::step(const View& view) noexcept {
  decision_.manoeuvre = {};
  decision_.looked = false;
  switch (request_) {
    case Request::none: break;
    case Request::goal: start(view); break;
    case Request::cancel: finish(Mode::idle, Why::cancelled, Outcome::none); break;
  }
  request_ = Request::none;
  if (phase_ != Phase::rest) {
    keep_account(view);
    act(view);
  }
  return decision_;
}

void SkirtPlanner::start(const View& view) noexcept {
  decision_ = Decision{};
  decision_.outcome = Outcome::running;
  last_ = view.pose;
  best_ = Length::from_raw(INT32_MAX);
  travel_mm_ = travel_rest_um_ = 0;
  left_edge_mm_ = -mm(kKeepSide);
  trail_.reset(view.pose.at, for_body(params_, 40_mm));
  course_.reset();
  surveyed_ = 0;
  escapes_ = 0;
  retreats_ = 0;
  slow_ticks_ = 0;
  enter(Phase::survey, Mode::surveying, Why::goal_set);
}

void SkirtPlanner::keep_account(const View& view) noexcept {
  const Length travel = norm(view.pose.at - last_.at);
  travel_rest_um_ += travel.raw();
  travel_mm_ += travel_rest_um_ / 1000;
  travel_rest_um_ %= 1000;
  circuit_.move(view.pose, travel, view.pose.heading - last_.heading);
  last_ = view.pose;
  to_goal_ = goal_.at - view.pose.at;
  distance_ = norm(to_goal_);
  if (trail_.add(view.pose.at)) retreats_ = 0;
}

void SkirtPlanner::act(const View& view) noexcept {
  if (travel_mm_ > mm(kLongest)) {
    finish(Mode::gave_up, Why::length_budget, Outcome::gave_up);
    return;
  }
  if (distance_ <= close_enough(goal_.tolerance)) {
    if (phase_ != Phase::brake || next_ != Phase::rest) brake_then(Phase::rest);
    if (view.settled) finish(Mode::arrived, Why::at_goal, Outcome::reached);
    return;
  }
  switch (phase_) {
    case Phase::rest: break;
    case Phase::brake:
      if (view.settled) phase_ = next_ == Phase::rest ? Phase::go : next_;
      break;
    case Phase::survey: survey(view); break;
    case Phase::go: go(view); break;
    case Phase::look: look(view); break;
    case Phase::exits: exits(view); break;
    case Phase::depart: depart(view); break;
    case Phase::follow: follow(view); break;
    case Phase::feel: feel(view); break;
    case Phase::retreat: retreat(view); break;
  }
}

void SkirtPlanner::survey(const View& view) noexcept {
  const Angle side = surveyed_ == 0 ? kSurvey : -kSurvey;
  if (turn_to(view, bearing(to_goal_) + side) && ++surveyed_ == 2) {
    enter(Phase::go, Mode::going, Why::target_free);
  }
}

void SkirtPlanner::go(const View& view) noexcept {
  best_ = min(best_, distance_);
  if (view.sighted && !course_.choose(view, to_goal_, law_, params_, wall_, decision_)) {
    begin_exits(view);
    return;
  }
  const Length length = min(probe_length(params_), distance_);
  if (stalled(view)) {
    look_along(course_.heading(), length, Phase::go);
    return;
  }
  // Held back by something unseen: a small turn may already show it.
  Angle heading = course_.heading();
  Angle aside;
  if (view.granted < kHindered && turn_to_unseen(view, heading, length, heading, params_, aside)) {
    const int32_t most = static_cast<int32_t>(kCheapTurn.raw());
    const int32_t turn = aside.wrapped();
    heading += Angle::from_raw(static_cast<uint32_t>(turn > most ? most : turn < -most ? -most : turn));
  }
  drive(steer(heading - view.pose.heading, params_.wheels.max_speed));
}

int32_t SkirtPlanner::mm(Length reference) const noexcept {
  return for_body(params_, reference).raw() / 1000;
}

bool SkirtPlanner::stalled(const View& view) noexcept {
  const Speed slow = params_.wheels.max_speed / 15;
  constexpr AngularRate kTurns = 300_mrad_per_s;
  // What it takes to start moving, and for readings to show what is ahead: 0.2 s; 0.8 s while it turns.
  const Duration starts = params_.wheels.motor_lag * 2 + params_.rangefinders.latency +
                          milliseconds(4000 / params_.rangefinders.rate_hz);
  const int32_t patience = 4 * starts.raw() / params_.safety.period.raw();
  const bool turns = abs(view.turning) > kTurns * (params_.body.track / 2);
  const bool held = !turns && view.granted < Q14::ratio(1, 1);
  slow_ticks_ = view.forward < slow ? slow_ticks_ + (held ? 4 : 1) : 0;
  return slow_ticks_ >= patience;
}

void SkirtPlanner::look_along(Angle heading, Length length, Phase next) noexcept {
  heading_ = heading;
  length_ = length;
  enter(Phase::look, Mode::looking, Why::unknown_ahead);
  next_ = next;
  decision_.manoeuvre.kind = Kind::stop;
  halting_ = true;
}

void SkirtPlanner::look(const View& view) noexcept {
  Angle turn;
  if (!turn_to_unseen(view, heading_, length_, view.pose.heading, params_, turn)) {
    decision_.looked = true;
    enter(next_, next_ == Phase::go ? Mode::going : Mode::skirting, decision_.why);
    return;
  }
  if (magnitude(turn) > (1_deg).raw()) {
    halting_ = false;
    drive(face(turn));
  } else if (!halting_) {
    decision_.manoeuvre.kind = Kind::stop;
    halting_ = true;
  }
}

void SkirtPlanner::begin_exits(const View& view) noexcept {
  const Angle target = bearing(to_goal_);
  circuit_.begin(view.pose.at, params_);
  course_.reset();
  turned_back_ = false;
  if (travel_mm_ - left_edge_mm_ < mm(kKeepSide)) {
    exits_.begin_on(target, opposite(wall_));
  } else {
    exits_.begin(target, (view.pose.heading - target).wrapped() > 0 ? Side::left : Side::right);
  }
  enter(Phase::exits, Mode::searching, Why::target_blocked);
}

void SkirtPlanner::exits(const View& view) noexcept {
  Twist twist;
  const bool over = exits_.step(view, params_, twist);
  drive(twist);
  if (!over) return;
  if (!exits_.found()) {
    begin_feel(view, bearing(to_goal_));
    return;
  }
  wall_ = opposite(exits_.side());
  heading_ = exits_.heading();
  circuit_.head(heading_);
  effort_ = Effort::full;
  enter(Phase::depart, Mode::skirting, wall_ == Side::right ? Why::exit_left : Why::exit_right);
}

void SkirtPlanner::depart(const View& view) noexcept {
  if (!turn_to(view, heading_)) return;
  commit_mm_ = travel_mm_ + mm(kCommit);
  felt_mm_ = travel_mm_;
  enter(Phase::follow, Mode::skirting, decision_.why);
}

void SkirtPlanner::follow(const View& view) noexcept {
  if (view.sighted) {
    if (circuit_.closed(view.pose)) {
      turn_back(view);
      return;
    }
    if (circuit_.strays(view.pose)) {
      escape();
      return;
    }
    if (leave(view)) return;
    if (travel_mm_ - felt_mm_ > mm(kOpeningEvery)) {
      felt_mm_ = travel_mm_;
      if (opening(view)) {
        begin_feel(view, view.pose.heading);
        decision_.why = Why::opening;
        return;
      }
    }
  }
  if (stalled(view)) {
    begin_feel(view, view.pose.heading);
    return;
  }
  if (travel_mm_ < commit_mm_) {
    drive(steer(heading_ - view.pose.heading, params_.wheels.max_speed));
    return;
  }
  decision_.why = Why::edge;
  drive(along_edge(view.sight, wall_, params_));
}

bool SkirtPlanner::leave(const View& view) noexcept {
  if (distance_ >= best_ - for_body(params_, kProgress)) return false;
  const Angle target = bearing(to_goal_);
  const Way found = way(view, target, min(probe_length(params_), distance_), planning_reach(params_));
  // Away from the wall the unseen may be tried; on its side it is most likely the wall.
  const bool wall_side = (target - view.pose.heading).wrapped() * int64_t{sign(wall_)} > 0;
  if (found == Way::blocked || (found == Way::open && wall_side)) return false;
  left_edge_mm_ = travel_mm_;
  course_.reset();
  enter(Phase::go, Mode::going, Why::target_free);
  go(view);
  return true;
}

/// On the wall's side something is nearly clear: a door, or the end of the wall.
bool SkirtPlanner::opening(const View& view) const noexcept {
  const Angle back = trail_.way_back(view.pose);
  const Length reach = planning_reach(params_);
  for (int32_t degrees = 60; degrees <= 105; degrees += 15) {
    const Angle heading = view.pose.heading + 1_deg * (degrees * sign(wall_));
    if (magnitude(heading - back) < kNotBack.raw()) continue;
    const ground::Obstacles o =
        view.patch->along(view.pose.at, heading, for_body(params_, kOpeningWay), reach);
    if (o.suspect + o.unknown <= kOpeningCells) return true;
  }
  return false;
}

void SkirtPlanner::escape() noexcept {
  if (++escapes_ > kEscapes) {
    finish(Mode::unreachable, Why::came_round, Outcome::unreachable);
    return;
  }
  best_ = distance_;
  left_edge_mm_ = travel_mm_ - mm(kKeepSide);
  enter(Phase::go, Mode::going, Why::wall_lost);
}

void SkirtPlanner::turn_back(const View& view) noexcept {
  if (turned_back_) {
    finish(Mode::unreachable, Why::came_round, Outcome::unreachable);
    return;
  }
  // A gap that is closed from one side may be open from the other one.
  turned_back_ = true;
  wall_ = opposite(wall_);
  const Angle back = view.pose.heading + 180_deg;
  circuit_.begin(view.pose.at, params_);
  circuit_.head(back);
  begin_feel(view, back);
  decision_.why = Why::came_round;
}

void SkirtPlanner::begin_feel(const View& view, Angle ahead) noexcept {
  // From the wall's side, but not from beyond the wall: where the robot came from lies there.
  Angle swing = kFeelFrom;
  const Angle to_back = (trail_.way_back(view.pose) - ahead) * sign(wall_);
  if (to_back.raw() > kNotBack.raw() && (to_back - kNotBack).raw() < swing.raw()) swing = to_back - kNotBack;
  feel_from_ = ahead + swing * sign(wall_);
  candidate_ = 0;
  effort_ = Effort::full;
  brake_then(Phase::feel);
}

Length SkirtPlanner::reach() const noexcept {
  return effort_ == Effort::full ? probe_length(params_) : for_body(params_, kShortWay);
}

void SkirtPlanner::feel(const View& view) noexcept {
  constexpr Angle kStep = Angle::turns(75, 3600);
  constexpr Angle kFineStep = Angle::turns(25, 3600);
  const bool fine = effort_ == Effort::narrow_ways;
  const Angle step = fine ? kFineStep : kStep;
  const Length margin = fine ? shield_reach(params_) : planning_reach(params_);
  decision_.mode = Mode::searching;
  for (const int32_t all = fine ? 144 : 48; candidate_ < all; ++candidate_) {
    const Angle heading = feel_from_ - step * (candidate_ * sign(wall_));
    const Way found = way(view, heading, reach(), margin);
    if (found == Way::blocked || (fine && found == Way::open)) continue;
    if (found == Way::open) {
      look_along(heading, reach(), Phase::feel);
      return;
    }
    heading_ = heading;
    enter(Phase::depart, Mode::skirting, Why::edge);
    return;
  }
  candidate_ = 0;
  switch (effort_) {
    case Effort::full: effort_ = Effort::short_ways; return;
    case Effort::short_ways: effort_ = Effort::narrow_ways; return;
    case Effort::narrow_ways: break;
  }
  retreat_to_ = trail_.near();
  enter(Phase::retreat, Mode::skirting, Why::way_back);
}

void SkirtPlanner::retreat(const View& view) noexcept {
  const Vec rest = retreat_to_ - view.pose.at;
  if (norm(rest) < for_body(params_, 10_mm)) {
    felt_mm_ = travel_mm_;
    enter(Phase::follow, Mode::skirting, Why::edge);
  } else if (!stalled(view)) {
    drive(steer(bearing(rest) - view.pose.heading, params_.wheels.max_speed / 2));
  } else if (++retreats_ < kRetreats) {
    begin_feel(view, view.pose.heading);
  } else {
    finish(Mode::gave_up, Why::no_exit, Outcome::gave_up);
  }
}

void SkirtPlanner::enter(Phase phase, Mode mode, Why why) noexcept {
  phase_ = phase;
  slow_ticks_ = 0;
  decision_.mode = mode;
  decision_.why = why;
}

void SkirtPlanner::brake_then(Phase next) noexcept {
  enter(Phase::brake, decision_.mode, decision_.why);
  next_ = next;
  decision_.manoeuvre = {};
  decision_.manoeuvre.kind = Kind::stop;
}

bool SkirtPlanner::turn_to(const View& view, Angle heading) noexcept {
  const Angle error = heading - view.pose.heading;
  drive(face(error));
  return magnitude(error) < kFacing.raw();
}

void SkirtPlanner::finish(Mode mode, Why why, Outcome outcome) noexcept {
  phase_ = Phase::rest;
  decision_.mode = mode;
  decision_.why = why;
  decision_.outcome = outcome;
  decision_.manoeuvre = {};
  decision_.manoeuvre.kind = Kind::stop;
}

}  // namespace whisker::nav
