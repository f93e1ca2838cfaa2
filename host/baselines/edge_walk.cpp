#include "host/baselines/edge_walk.hpp"

#include "firmware/nav/edge.hpp"
#include "firmware/nav/steering.hpp"
#include "firmware/nav/ways.hpp"

namespace whisker::baselines {
namespace {

constexpr Length kShortProbe = 60_mm;  // as all lengths here: for a body of 0.09 m
constexpr Length kOpening = 100_mm;
constexpr Angle kCoarse = Angle::turns(75, 3600);
constexpr std::int32_t kCoarseCircle = 48;
constexpr Angle kFine = Angle::turns(25, 3600);
constexpr std::int32_t kFineCircle = 144;
constexpr Angle kNotBack = 45_deg;
constexpr std::int32_t kRetreats = 8;

}  // namespace

void EdgeWalk::forget_trail(const nav::View& view) {
  trail_.reset(view.pose.at, for_body(params_, 40_mm));
  last_ = view.pose.at;
}

void EdgeWalk::note(const nav::View& view) {
  travel_um_ += norm(view.pose.at - last_).raw();
  last_ = view.pose.at;
  if (trail_.add(view.pose.at)) retreats_ = 0;
}

void EdgeWalk::begin(nav::Side wall, Angle blocked) {
  wall_ = wall;
  course_ = blocked;
  feel_from(blocked);
}

void EdgeWalk::feel_from(Angle heading) {
  feel_from_ = heading;
  candidate_ = 0;
  reach_ = probe_length(params_);
  fine_ = false;
  phase_ = Phase::brake;
}

/// From the wall's side, but not from beyond the wall: where it came from lies there.
void EdgeWalk::feel_from_wall(const nav::View& view, Angle heading) {
  course_ = heading;
  Angle swing = 110_deg;
  const Angle to_back = (trail_.way_back({view.pose.at, heading}) - course_) * turn();
  const Angle past_back = to_back - kNotBack;
  if (to_back.raw() > kNotBack.raw() && past_back.raw() < swing.raw()) swing = past_back;
  feel_from(course_ + swing * turn());
}

bool EdgeWalk::step(const nav::View& view, nav::Decision& decision) {
  switch (phase_) {
    case Phase::brake:
      if (view.settled) phase_ = Phase::feel;
      return true;
    case Phase::feel: feel(view, decision); return true;
    case Phase::look:
      decision.mode = nav::Mode::looking;
      if (look_.step(view, look_along_, reach_, params_, decision.manoeuvre)) {
        decision.looked = true;
        phase_ = Phase::feel;
      }
      return true;
    case Phase::turn:
      decision.mode = nav::Mode::skirting;
      if (face(view, course_, params_, decision.manoeuvre)) {
        stall_.reset();
        straight_until_um_ = travel_um_ + min(for_body(params_, kShortProbe), reach_).raw();
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
  if (travel_um_ - felt_um_ <= Length{100_mm}.raw()) return false;
  felt_um_ = travel_um_;
  const Angle back = trail_.way_back(view.pose);
  for (std::int32_t i = 4; i <= 7; ++i) {
    const Angle heading = view.pose.heading + 15_deg * (i * turn());
    if (magnitude(heading - back) < kNotBack.raw()) continue;
    const ground::Obstacles o =
        view.patch->along(view.pose.at, heading, for_body(params_, kOpening), planning_reach(params_));
    if (o.suspect + o.unknown <= 6) return true;
  }
  return false;
}

void EdgeWalk::walk(const nav::View& view, nav::Decision& decision) {
  decision.mode = nav::Mode::skirting;
  decision.why = nav::Why::edge;
  const bool opens = view.sighted && may_open(view);
  if (opens || stall_.stalled(view, params_)) {
    if (opens) decision.why = nav::Why::opening;
    decision.manoeuvre = stop();
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
  const Angle step = fine_ ? kFine : kCoarse;
  const Length beside = fine_ ? shield_reach(params_) : planning_reach(params_);
  for (; candidate_ < (fine_ ? kFineCircle : kCoarseCircle); ++candidate_) {
    const Angle heading = feel_from_ - step * (candidate_ * turn());
    const nav::Way found = nav::way(view, heading, reach_, beside);
    if (found == nav::Way::blocked || (fine_ && found == nav::Way::open)) continue;
    if (found == nav::Way::open) {
      look_.begin();
      look_along_ = heading;
      decision.why = nav::Why::unknown_ahead;
      decision.manoeuvre = stop();
      phase_ = Phase::look;
    } else {
      course_ = heading;
      phase_ = Phase::turn;
    }
    return;
  }
  candidate_ = 0;
  if (reach_ == probe_length(params_)) {
    reach_ = for_body(params_, kShortProbe);
  } else if (!fine_) {
    fine_ = true;
  } else {
    fine_ = false;
    retreat_to_ = trail_.near();
    stall_.reset();
    phase_ = Phase::retreat;
  }
}

bool EdgeWalk::retreat(const nav::View& view, nav::Decision& decision) {
  decision.mode = nav::Mode::skirting;
  decision.why = nav::Why::way_back;
  const Vec rest = retreat_to_ - view.pose.at;
  if (norm(rest) < 10_mm) {
    felt_um_ = travel_um_;
    stall_.reset();
    phase_ = Phase::walk;
    return true;
  }
  if (stall_.stalled(view, params_)) {
    if (++retreats_ >= kRetreats) return false;
    decision.manoeuvre = stop();
    feel_from_wall(view, view.pose.heading);
    return true;
  }
  decision.manoeuvre =
      nav::cruise(nav::steer(bearing(rest) - view.pose.heading, params_.wheels.max_speed / 2), params_);
  return true;
}

}  // namespace whisker::baselines
