#include "firmware/planning/boundary/boundary_planner.hpp"

#include "firmware/planning/boundary/wall_following.hpp"

namespace whisker::planning {
namespace {

constexpr Angle kSurvey = 50_deg;  // with the cones' rims, 92 degrees to each side
constexpr Length kProgress = 30_mm;
constexpr Length kKeepSide = 500_mm;    // of travel after a leave
constexpr Length kOtherSide = 4500_mm;  // of travel after a lost wall, beside kKeepSide
constexpr int8_t kEscapes = 6;

constexpr Angle kCheapTurn = 25_deg;
constexpr Q14 kHindered = Q14::ratio(9, 10);
constexpr Q14 kAll = Q14::ratio(1, 1);

constexpr Length kCommit = 60_mm;
constexpr Length kRefused = 5_mm;  // of the commitment: the guard did not let it begin
constexpr int kRefusals = 10;
constexpr int16_t kMostPauses = 1000;
constexpr Length kOpeningEvery = 100_mm;

static_assert(sizeof(BoundaryPlanner) + sizeof(perception::LocalGrid) < 1024);

}  // namespace

void BoundaryPlanner::start(const View& view) noexcept {
  began_ = view.pose.at;
  last_ = view.pose;
  best_.reset();
  travel_mm_ = travel_rest_um_ = 0;
  paused_mm_ = pauses_ = 0;
  left_edge_mm_ = -mm(kKeepSide);
  heading_search_.reset(view.pose.at, params_);
  course_.reset();
  surveyed_ = 0;
  escapes_ = 0;
  guided_ = false;
  if (guide_ != nullptr) guide_->start(view, goal_);
  enter(Phase::survey, Mode::surveying, Why::goal_set);
  advance(view);
}

void BoundaryPlanner::follow_goal() noexcept {
  best_.follow(goal_.at);
  if (guide_ != nullptr) guide_->move_goal(goal_.at);
}

void BoundaryPlanner::advance(const View& view) noexcept {
  if (decision_.why == Why::something_moves) decision_.why = otherwise_;
  keep_account(view);
  if (guide_ != nullptr) guide_->observe(view);
  act(view);
  if (gives_way(view)) {
    otherwise_ = decision_.why;
    decision_.why = Why::something_moves;
  }
}

bool BoundaryPlanner::gives_way(const View& view) const noexcept {
  if (decision_.outcome != Outcome::running || !view.local_grid->doubting()) return false;
  switch (phase_) {
    case Phase::survey: break;
    case Phase::go: return view.granted < kAll || decision_.why == Why::narrow;
    case Phase::brake:
    case Phase::depart:
    case Phase::follow: return view.granted < kAll;
    case Phase::look:
    case Phase::exits:
    case Phase::feel:
    case Phase::retreat: return true;
  }
  return false;
}

void BoundaryPlanner::keep_account(const View& view) noexcept {
  const Length travel = norm(view.pose.at - last_.at);
  travel_rest_um_ += travel.raw();
  travel_mm_ += travel_rest_um_ / 1000;
  travel_rest_um_ %= 1000;
  loop_.move(view.pose, travel, view.pose.heading - last_.heading);
  last_ = view.pose;
  to_goal_ = goal_.at - view.pose.at;
  distance_ = norm(to_goal_);
  heading_search_.move(view.pose.at);
  if (travel_mm_ - paused_mm_ > mm(kProgress)) {
    paused_mm_ = travel_mm_;
    pauses_ = 0;
  }
}

void BoundaryPlanner::act(const View& view) noexcept {
  if (travel_mm_ > params_.skirt.length_budget.raw() / 1000) {
    finish(Mode::gave_up, Why::length_budget, Outcome::gave_up);
    return;
  }
  if (pauses_ > kMostPauses) {
    finish(Mode::gave_up, Why::no_exit, Outcome::gave_up);
    return;
  }
  if (is_goal(distance_)) {
    if (phase_ != Phase::brake || next_ != Phase::go) brake_then(Phase::go);
    if (view.settled) finish(Mode::arrived, Why::at_goal, Outcome::reached);
    return;
  }
  switch (phase_) {
    case Phase::brake:
      if (view.settled) phase_ = next_;
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

void BoundaryPlanner::survey(const View& view) noexcept {
  const Angle side = surveyed_ == 0 ? kSurvey : -kSurvey;
  if (turn_to(view, bearing(to_goal_) + side) && ++surveyed_ == 2) {
    enter(Phase::go, Mode::going, Why::target_free);
  }
}

void BoundaryPlanner::go(const View& view) noexcept {
  if (distance_ < best_.distance()) measure_anew();
  Vec to = to_goal_;
  if (guide_ != nullptr && guided(view, to)) return;
  if (view.sighted && !course_.choose(view, to, law_, params_, wall_, decision_)) {
    if (guided_ && guide_->refuse(view)) {
      course_.reset();
      brake_then(Phase::go);
      return;
    }
    if (guided_) measure_anew();
    guided_ = false;
    begin_exits(view);
    return;
  }
  const Length length = min(view.local_grid->reach().probe, norm(to));
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

bool BoundaryPlanner::guided(const View& view, Vec& to) noexcept {
  const GlobalPlanner::Advice advice = guide_->advise(view, distance_, to);
  // It may have led away from the goal: what comes now is measured anew.
  if (guided_ && advice == GlobalPlanner::Advice::none) measure_anew();
  guided_ = advice != GlobalPlanner::Advice::none;
  if (advice != GlobalPlanner::Advice::wait) return false;
  decision_.manoeuvre = stop();
  stuck_.reset();
  return true;
}

int32_t BoundaryPlanner::mm(Length reference) const noexcept {
  return for_body(params_, reference).raw() / 1000;
}

void BoundaryPlanner::look_along(Angle heading, Length length, Phase next) noexcept {
  heading_ = heading;
  length_ = length;
  enter(Phase::look, Mode::looking, Why::unknown_ahead);
  next_ = next;
  scan_.begin(decision_.manoeuvre);
}

void BoundaryPlanner::look(const View& view) noexcept {
  if (!scan_.step(view, heading_, length_, params_, decision_.manoeuvre)) return;
  decision_.looked = true;
  if (scan_.in_vain()) {
    if (next_ == Phase::go) {
      begin_exits(view);
      return;
    }
    heading_search_.refuse();
  }
  enter(next_, next_ == Phase::go ? Mode::going : Mode::skirting, decision_.why);
}

void BoundaryPlanner::begin_exits(const View& view) noexcept {
  const Angle target = bearing(to_goal_);
  loop_.begin(view.pose.at, params_);
  course_.reset();
  turned_back_ = false;
  if (travel_mm_ - left_edge_mm_ < mm(kKeepSide)) {
    exits_.begin_on(target, opposite(wall_));
  } else {
    exits_.begin(target, (view.pose.heading - target).wrapped() > 0 ? Side::left : Side::right);
  }
  enter(Phase::exits, Mode::searching, Why::target_blocked);
}

void BoundaryPlanner::exits(const View& view) noexcept {
  Twist twist;
  const bool over = exits_.step(view, twist);
  drive(twist);
  if (!over) return;
  if (!exits_.found()) {
    begin_feel(view, bearing(to_goal_));
    return;
  }
  wall_ = opposite(exits_.side());
  heading_ = exits_.heading();
  felt_heading_ = false;
  loop_.head(heading_);
  enter(Phase::depart, Mode::skirting, wall_ == Side::right ? Why::exit_left : Why::exit_right);
}

void BoundaryPlanner::depart(const View& view) noexcept {
  if (!turn_to(view, heading_)) return;
  commit_mm_ = travel_mm_ + mm(kCommit);
  felt_mm_ = travel_mm_;
  enter(Phase::follow, Mode::skirting, decision_.why);
}

void BoundaryPlanner::follow(const View& view) noexcept {
  if (view.sighted) {
    if (loop_.closed(view.pose)) {
      turn_back(view);
      return;
    }
    if (loop_.strays(view.pose)) {
      escape();
      return;
    }
    if (leave(view)) return;
    if (travel_mm_ - felt_mm_ > mm(kOpeningEvery)) {
      felt_mm_ = travel_mm_;
      if (heading_search_.opening(view, wall_, params_)) {
        begin_feel(view, view.pose.heading);
        decision_.why = Why::opening;
        return;
      }
    }
  }
  if (stalled(view)) {
    feel_on(view);
    return;
  }
  if (travel_mm_ < commit_mm_) {
    drive(steer(heading_ - view.pose.heading, params_.wheels.max_speed));
    return;
  }
  decision_.why = Why::edge;
  drive(along_edge(view.moving_scan, wall_, params_));
}

bool BoundaryPlanner::leave(const View& view) noexcept {
  if (distance_ >= best_.distance() - for_body(params_, kProgress)) return false;
  const Angle target = bearing(to_goal_);
  const Reach& reach = view.local_grid->reach();
  const Way found = way(view, target, min(reach.probe, distance_), reach.planning);
  // Away from the wall the unseen may be tried; on its side it is most likely the wall.
  const bool wall_side = (target - view.pose.heading).wrapped() * int64_t{sign(wall_)} > 0;
  if (found == Way::occupied || (found == Way::unknown && wall_side)) return false;
  left_edge_mm_ = travel_mm_;
  course_.reset();
  enter(Phase::go, Mode::going, Why::target_free);
  go(view);
  return true;
}

void BoundaryPlanner::escape() noexcept {
  if (++escapes_ > kEscapes) {
    give_up_goal();
    return;
  }
  measure_anew();
  wall_ = opposite(wall_);
  left_edge_mm_ = travel_mm_ + mm(kOtherSide);
  enter(Phase::go, Mode::going, Why::wall_lost);
}

void BoundaryPlanner::give_up_goal() noexcept {
  if (guide_ != nullptr && guide_->doubt()) {
    measure_anew();
    escapes_ = 0;
    enter(Phase::go, Mode::going, Why::wall_lost);
    return;
  }
  finish(Mode::unreachable, Why::came_round, Outcome::unreachable);
}

void BoundaryPlanner::turn_back(const View& view) noexcept {
  if (turned_back_ || (guide_ != nullptr && guide_->knows_no_way())) {
    if (loop_.may_part(began_, goal_.at, wall_)) {
      give_up_goal();
    } else {
      escape();
    }
    return;
  }
  // A gap that is closed from one side may be open from the other one.
  turned_back_ = true;
  wall_ = opposite(wall_);
  const Angle back = view.pose.heading + 180_deg;
  loop_.begin(view.pose.at, params_);
  loop_.head(back);
  begin_feel(view, back);
  decision_.why = Why::came_round;
}

void BoundaryPlanner::begin_feel(const View& view, Angle ahead) noexcept {
  heading_search_.begin_at_wall(ahead, view.pose, wall_);
  brake_then(Phase::feel);
}

void BoundaryPlanner::feel_on(const View& view) noexcept {
  const bool refused = felt_heading_ && commit_mm_ - travel_mm_ >= mm(kCommit - kRefused);
  if (!refused)
    refusals_ = 0;
  else if (refusals_ < kRefusals)
    ++refusals_;
  // Turned to that heading, it may have seen more on the wall's side.
  if (refusals_ < kRefusals) {
    begin_feel(view, view.pose.heading);
    return;
  }
  heading_search_.refuse();
  brake_then(Phase::feel);
}

void BoundaryPlanner::feel(const View& view) noexcept {
  decision_.mode = Mode::searching;
  HeadingSearch::Heading found;
  switch (heading_search_.step(view, params_, found)) {
    case HeadingSearch::Found::nothing: break;
    case HeadingSearch::Found::unseen: look_along(found.angle, found.length, Phase::feel); break;
    case HeadingSearch::Found::free:
      heading_ = found.angle;
      felt_heading_ = true;
      enter(Phase::depart, Mode::skirting, Why::edge);
      break;
    case HeadingSearch::Found::none: enter(Phase::retreat, Mode::skirting, Why::way_back); break;
  }
}

void BoundaryPlanner::retreat(const View& view) noexcept {
  switch (heading_search_.retreat(view, stalled(view), params_, decision_.manoeuvre)) {
    case HeadingSearch::Retreat::under_way: break;
    case HeadingSearch::Retreat::there:
      felt_mm_ = travel_mm_;
      enter(Phase::follow, Mode::skirting, Why::edge);
      break;
    case HeadingSearch::Retreat::stuck: begin_feel(view, view.pose.heading); break;
    case HeadingSearch::Retreat::lost: finish(Mode::gave_up, Why::no_exit, Outcome::gave_up); break;
  }
}

void BoundaryPlanner::enter(Phase phase, Mode mode, Why why) noexcept {
  phase_ = phase;
  ++pauses_;
  stuck_.reset();
  tell(mode, why);
}

void BoundaryPlanner::brake_then(Phase next) noexcept {
  enter(Phase::brake, decision_.mode, decision_.why);
  next_ = next;
  decision_.manoeuvre = stop();
}

bool BoundaryPlanner::turn_to(const View& view, Angle heading) noexcept {
  return turn_by(heading - view.pose.heading, params_, decision_.manoeuvre);
}

}  // namespace whisker::planning
