#include "firmware/nav/skirt.hpp"

#include "firmware/nav/edge.hpp"

namespace whisker::nav {
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
constexpr Length kRefused = 5_mm;  // of the commitment: the shield did not let it begin
constexpr int kRefusals = 10;
constexpr int16_t kMostPauses = 1000;
constexpr Length kOpeningEvery = 100_mm;

static_assert(sizeof(SkirtPlanner) + sizeof(ground::Patch) < 1024);

}  // namespace

void SkirtPlanner::start(const View& view) noexcept {
  began_ = view.pose.at;
  last_ = view.pose;
  best_.reset();
  travel_mm_ = travel_rest_um_ = 0;
  paused_mm_ = pauses_ = 0;
  left_edge_mm_ = -mm(kKeepSide);
  feeler_.reset(view.pose.at, params_);
  course_.reset();
  surveyed_ = 0;
  escapes_ = 0;
  guided_ = false;
  if (guide_ != nullptr) guide_->start(view, goal_);
  enter(Phase::survey, Mode::surveying, Why::goal_set);
  advance(view);
}

void SkirtPlanner::follow_goal() noexcept {
  best_.follow(goal_.at);
  if (guide_ != nullptr) guide_->move_goal(goal_.at);
}

void SkirtPlanner::advance(const View& view) noexcept {
  if (decision_.why == Why::something_moves) decision_.why = otherwise_;
  keep_account(view);
  if (guide_ != nullptr) guide_->observe(view);
  act(view);
  if (gives_way(view)) {
    otherwise_ = decision_.why;
    decision_.why = Why::something_moves;
  }
}

bool SkirtPlanner::gives_way(const View& view) const noexcept {
  if (decision_.outcome != Outcome::running || !view.patch->doubting()) return false;
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

void SkirtPlanner::keep_account(const View& view) noexcept {
  const Length travel = norm(view.pose.at - last_.at);
  travel_rest_um_ += travel.raw();
  travel_mm_ += travel_rest_um_ / 1000;
  travel_rest_um_ %= 1000;
  circuit_.move(view.pose, travel, view.pose.heading - last_.heading);
  last_ = view.pose;
  to_goal_ = goal_.at - view.pose.at;
  distance_ = norm(to_goal_);
  feeler_.move(view.pose.at);
  if (travel_mm_ - paused_mm_ > mm(kProgress)) {
    paused_mm_ = travel_mm_;
    pauses_ = 0;
  }
}

void SkirtPlanner::act(const View& view) noexcept {
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

void SkirtPlanner::survey(const View& view) noexcept {
  const Angle side = surveyed_ == 0 ? kSurvey : -kSurvey;
  if (turn_to(view, bearing(to_goal_) + side) && ++surveyed_ == 2) {
    enter(Phase::go, Mode::going, Why::target_free);
  }
}

void SkirtPlanner::go(const View& view) noexcept {
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
  const Length length = min(view.patch->reach().probe, norm(to));
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

bool SkirtPlanner::guided(const View& view, Vec& to) noexcept {
  const Guide::Advice advice = guide_->advise(view, distance_, to);
  // It may have led away from the goal: what comes now is measured anew.
  if (guided_ && advice == Guide::Advice::none) measure_anew();
  guided_ = advice != Guide::Advice::none;
  if (advice != Guide::Advice::wait) return false;
  decision_.manoeuvre = stop();
  stall_.reset();
  return true;
}

int32_t SkirtPlanner::mm(Length reference) const noexcept {
  return for_body(params_, reference).raw() / 1000;
}

void SkirtPlanner::look_along(Angle heading, Length length, Phase next) noexcept {
  heading_ = heading;
  length_ = length;
  enter(Phase::look, Mode::looking, Why::unknown_ahead);
  next_ = next;
  look_.begin(decision_.manoeuvre);
}

void SkirtPlanner::look(const View& view) noexcept {
  if (!look_.step(view, heading_, length_, params_, decision_.manoeuvre)) return;
  decision_.looked = true;
  if (look_.in_vain()) {
    if (next_ == Phase::go) {
      begin_exits(view);
      return;
    }
    feeler_.refuse();
  }
  enter(next_, next_ == Phase::go ? Mode::going : Mode::skirting, decision_.why);
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
  circuit_.head(heading_);
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
      if (feeler_.opening(view, wall_, params_)) {
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
  drive(along_edge(view.sight, wall_, params_));
}

bool SkirtPlanner::leave(const View& view) noexcept {
  if (distance_ >= best_.distance() - for_body(params_, kProgress)) return false;
  const Angle target = bearing(to_goal_);
  const Reach& reach = view.patch->reach();
  const Way found = way(view, target, min(reach.probe, distance_), reach.planning);
  // Away from the wall the unseen may be tried; on its side it is most likely the wall.
  const bool wall_side = (target - view.pose.heading).wrapped() * int64_t{sign(wall_)} > 0;
  if (found == Way::blocked || (found == Way::open && wall_side)) return false;
  left_edge_mm_ = travel_mm_;
  course_.reset();
  enter(Phase::go, Mode::going, Why::target_free);
  go(view);
  return true;
}

void SkirtPlanner::escape() noexcept {
  if (++escapes_ > kEscapes) {
    give_up_goal();
    return;
  }
  measure_anew();
  wall_ = opposite(wall_);
  left_edge_mm_ = travel_mm_ + mm(kOtherSide);
  enter(Phase::go, Mode::going, Why::wall_lost);
}

void SkirtPlanner::give_up_goal() noexcept {
  if (guide_ != nullptr && guide_->doubt()) {
    measure_anew();
    escapes_ = 0;
    enter(Phase::go, Mode::going, Why::wall_lost);
    return;
  }
  finish(Mode::unreachable, Why::came_round, Outcome::unreachable);
}

void SkirtPlanner::turn_back(const View& view) noexcept {
  if (turned_back_ || (guide_ != nullptr && guide_->knows_no_way())) {
    if (circuit_.may_part(began_, goal_.at, wall_)) {
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
  circuit_.begin(view.pose.at, params_);
  circuit_.head(back);
  begin_feel(view, back);
  decision_.why = Why::came_round;
}

void SkirtPlanner::begin_feel(const View& view, Angle ahead) noexcept {
  feeler_.begin_at_wall(ahead, view.pose, wall_);
  brake_then(Phase::feel);
}

void SkirtPlanner::feel_on(const View& view) noexcept {
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
  feeler_.refuse();
  brake_then(Phase::feel);
}

void SkirtPlanner::feel(const View& view) noexcept {
  decision_.mode = Mode::searching;
  Feeler::Heading found;
  switch (feeler_.step(view, params_, found)) {
    case Feeler::Found::nothing: break;
    case Feeler::Found::unseen: look_along(found.angle, found.length, Phase::feel); break;
    case Feeler::Found::free:
      heading_ = found.angle;
      felt_heading_ = true;
      enter(Phase::depart, Mode::skirting, Why::edge);
      break;
    case Feeler::Found::none: enter(Phase::retreat, Mode::skirting, Why::way_back); break;
  }
}

void SkirtPlanner::retreat(const View& view) noexcept {
  switch (feeler_.retreat(view, stalled(view), params_, decision_.manoeuvre)) {
    case Feeler::Retreat::under_way: break;
    case Feeler::Retreat::there:
      felt_mm_ = travel_mm_;
      enter(Phase::follow, Mode::skirting, Why::edge);
      break;
    case Feeler::Retreat::stuck: begin_feel(view, view.pose.heading); break;
    case Feeler::Retreat::lost: finish(Mode::gave_up, Why::no_exit, Outcome::gave_up); break;
  }
}

void SkirtPlanner::enter(Phase phase, Mode mode, Why why) noexcept {
  phase_ = phase;
  ++pauses_;
  stall_.reset();
  tell(mode, why);
}

void SkirtPlanner::brake_then(Phase next) noexcept {
  enter(Phase::brake, decision_.mode, decision_.why);
  next_ = next;
  decision_.manoeuvre = stop();
}

bool SkirtPlanner::turn_to(const View& view, Angle heading) noexcept {
  return turn_by(heading - view.pose.heading, params_, decision_.manoeuvre);
}

}  // namespace whisker::nav
