#include "host/baselines/edge_walk.hpp"

#include "firmware/planning/boundary/wall_following.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::baselines {
namespace {

constexpr Length kStraight = 60_mm;  // after a turn; for a body of 0.09 m
constexpr Length kOpeningEvery = 100_mm;

}  // namespace

void EdgeWalk::forget_trail(const planning::View& view) {
  heading_search_.reset(view.pose.at, params_);
  last_ = view.pose.at;
}

void EdgeWalk::note(const planning::View& view) {
  travel_um_ += norm(view.pose.at - last_).raw();
  last_ = view.pose.at;
  heading_search_.move(view.pose.at);
}

void EdgeWalk::begin(planning::Side wall, Angle blocked) {
  wall_ = wall;
  course_ = blocked;
  heading_search_.begin(blocked, {last_, blocked}, wall);
  phase_ = Phase::brake;
}

void EdgeWalk::feel_from_wall(const planning::View& view, Angle heading) {
  course_ = heading;
  heading_search_.begin_at_wall(heading, {view.pose.at, heading}, wall_);
  phase_ = Phase::brake;
}

bool EdgeWalk::step(const planning::View& view, planning::Decision& decision) {
  switch (phase_) {
    case Phase::brake:
      if (view.settled) phase_ = Phase::feel;
      return true;
    case Phase::feel: feel(view, decision); return true;
    case Phase::look:
      decision.mode = planning::Mode::looking;
      if (scan_.step(view, found_.angle, found_.length, params_, decision.manoeuvre)) {
        decision.looked = true;
        phase_ = Phase::feel;
      }
      return true;
    case Phase::turn:
      decision.mode = planning::Mode::skirting;
      if (planning::turn_by(course_ - view.pose.heading, params_, decision.manoeuvre)) {
        stuck_.reset();
        straight_until_um_ = travel_um_ + min(for_body(params_, kStraight), found_.length).raw();
        felt_um_ = travel_um_;
        phase_ = Phase::walk;
      }
      return true;
    case Phase::walk: walk(view, decision); return true;
    case Phase::retreat: return retreat(view, decision);
  }
  return false;
}

bool EdgeWalk::may_open(const planning::View& view) {
  if (travel_um_ - felt_um_ <= std::int64_t{kOpeningEvery.raw()}) return false;
  felt_um_ = travel_um_;
  return heading_search_.opening(view, wall_, params_);
}

void EdgeWalk::walk(const planning::View& view, planning::Decision& decision) {
  decision.mode = planning::Mode::skirting;
  decision.why = planning::Why::edge;
  const bool opens = view.sighted && may_open(view);
  if (opens || stuck_.stalled(view, kPatience, params_)) {
    if (opens) decision.why = planning::Why::opening;
    decision.manoeuvre = planning::stop();
    feel_from_wall(view, view.pose.heading);
    return;
  }
  const Speed top = params_.wheels.max_speed;
  decision.manoeuvre = planning::cruise(travel_um_ < straight_until_um_
                                            ? planning::steer(course_ - view.pose.heading, top)
                                            : planning::along_edge(view.moving_scan, wall_, params_),
                                        params_);
}

void EdgeWalk::feel(const planning::View& view, planning::Decision& decision) {
  decision.mode = planning::Mode::searching;
  switch (heading_search_.step(view, params_, found_)) {
    case planning::HeadingSearch::Found::nothing: break;
    case planning::HeadingSearch::Found::unseen:
      scan_.begin(decision.manoeuvre);
      decision.why = planning::Why::unknown_ahead;
      phase_ = Phase::look;
      break;
    case planning::HeadingSearch::Found::free:
      course_ = found_.angle;
      phase_ = Phase::turn;
      break;
    case planning::HeadingSearch::Found::none:
      stuck_.reset();
      phase_ = Phase::retreat;
      break;
  }
}

bool EdgeWalk::retreat(const planning::View& view, planning::Decision& decision) {
  decision.mode = planning::Mode::skirting;
  decision.why = planning::Why::way_back;
  switch (
      heading_search_.retreat(view, stuck_.stalled(view, kPatience, params_), params_, decision.manoeuvre)) {
    case planning::HeadingSearch::Retreat::under_way: return true;
    case planning::HeadingSearch::Retreat::there:
      felt_um_ = travel_um_;
      stuck_.reset();
      phase_ = Phase::walk;
      return true;
    case planning::HeadingSearch::Retreat::stuck:
      decision.manoeuvre = planning::stop();
      feel_from_wall(view, view.pose.heading);
      return true;
    case planning::HeadingSearch::Retreat::lost: break;
  }
  return false;
}

}  // namespace whisker::baselines
