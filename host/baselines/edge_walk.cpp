#include "host/baselines/edge_walk.hpp"

#include "firmware/nav/edge.hpp"
#include "firmware/nav/steering.hpp"

namespace whisker::baselines {
namespace {

constexpr Length kStraight = 60_mm;  // after a turn; for a body of 0.09 m
constexpr Length kOpeningEvery = 100_mm;

}  // namespace

void EdgeWalk::forget_trail(const nav::View& view) {
  feeler_.reset(view.pose.at, params_);
  last_ = view.pose.at;
}

void EdgeWalk::note(const nav::View& view) {
  travel_um_ += norm(view.pose.at - last_).raw();
  last_ = view.pose.at;
  feeler_.move(view.pose.at);
}

void EdgeWalk::begin(nav::Side wall, Angle blocked) {
  wall_ = wall;
  course_ = blocked;
  feeler_.begin(blocked, wall);
  phase_ = Phase::brake;
}

void EdgeWalk::feel_from_wall(const nav::View& view, Angle heading) {
  course_ = heading;
  feeler_.begin_at_wall(heading, {view.pose.at, heading}, wall_);
  phase_ = Phase::brake;
}

bool EdgeWalk::step(const nav::View& view, nav::Decision& decision) {
  switch (phase_) {
    case Phase::brake:
      if (view.settled) phase_ = Phase::feel;
      return true;
    case Phase::feel: feel(view, decision); return true;
    case Phase::look:
      decision.mode = nav::Mode::looking;
      if (look_.step(view, found_.angle, found_.length, params_, decision.manoeuvre)) {
        decision.looked = true;
        phase_ = Phase::feel;
      }
      return true;
    case Phase::turn:
      decision.mode = nav::Mode::skirting;
      if (nav::turn_by(course_ - view.pose.heading, params_, decision.manoeuvre)) {
        stall_.reset();
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

bool EdgeWalk::may_open(const nav::View& view) {
  if (travel_um_ - felt_um_ <= std::int64_t{kOpeningEvery.raw()}) return false;
  felt_um_ = travel_um_;
  return feeler_.opening(view, wall_, params_);
}

void EdgeWalk::walk(const nav::View& view, nav::Decision& decision) {
  decision.mode = nav::Mode::skirting;
  decision.why = nav::Why::edge;
  const bool opens = view.sighted && may_open(view);
  if (opens || stall_.stalled(view, kPatience, params_)) {
    if (opens) decision.why = nav::Why::opening;
    decision.manoeuvre = nav::stop();
    feel_from_wall(view, view.pose.heading);
    return;
  }
  const Speed top = params_.wheels.max_speed;
  decision.manoeuvre =
      nav::cruise(travel_um_ < straight_until_um_ ? nav::steer(course_ - view.pose.heading, top)
                                                  : nav::along_edge(view.sight, wall_, params_),
                  params_);
}

void EdgeWalk::feel(const nav::View& view, nav::Decision& decision) {
  decision.mode = nav::Mode::searching;
  switch (feeler_.step(view, params_, found_)) {
    case nav::Feeler::Found::nothing: break;
    case nav::Feeler::Found::unseen:
      look_.begin(decision.manoeuvre);
      decision.why = nav::Why::unknown_ahead;
      phase_ = Phase::look;
      break;
    case nav::Feeler::Found::free:
      course_ = found_.angle;
      phase_ = Phase::turn;
      break;
    case nav::Feeler::Found::none:
      stall_.reset();
      phase_ = Phase::retreat;
      break;
  }
}

bool EdgeWalk::retreat(const nav::View& view, nav::Decision& decision) {
  decision.mode = nav::Mode::skirting;
  decision.why = nav::Why::way_back;
  switch (feeler_.retreat(view, stall_.stalled(view, kPatience, params_), params_, decision.manoeuvre)) {
    case nav::Feeler::Retreat::under_way: return true;
    case nav::Feeler::Retreat::there:
      felt_um_ = travel_um_;
      stall_.reset();
      phase_ = Phase::walk;
      return true;
    case nav::Feeler::Retreat::stuck:
      decision.manoeuvre = nav::stop();
      feel_from_wall(view, view.pose.heading);
      return true;
    case nav::Feeler::Retreat::lost: break;
  }
  return false;
}

}  // namespace whisker::baselines
