#include "firmware/planning/boundary/boundary_planner.hpp"

#include "firmware/planning/candidate_headings.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::planning {
namespace {

constexpr Length kNearer = 30_mm;
constexpr Length kKeepSide = 500_mm;    // of travel after leaving a boundary
constexpr Length kOtherSide = 4500_mm;  // of travel after a lost wall, in addition to kKeepSide
constexpr int8_t kEscapes = 6;
constexpr int8_t kDoors = 3;           // tried in vain
constexpr Angle kStraightOn = 20_deg;  // of a door from the way

static_assert(sizeof(void*) > 4 || sizeof(BoundaryPlanner) + sizeof(perception::LocalGrid) <= 1824);

}  // namespace

void BoundaryPlanner::start(const View& view) noexcept {
  began_ = view.pose.at;
  behaviours_.progress.start(view);
  approach_.start(view, goal_);
  follower_.reset(view);
  survey_.reset();
  evasion_.reset();
  loop_.begin(view, behaviours_.params);
  left_edge_mm_ = -behaviours_.mm(kKeepSide);
  escapes_ = 0;
  passage_.reset();
  slits_.reset();
  sought_ = false;
  phase_ = Phase::survey;
  report(Mode::surveying, Why::goal_set);
  advance(view);
}

void BoundaryPlanner::advance(const View& view) noexcept {
  if (decision_.why == Why::something_moves) decision_.why = otherwise_;
  target_ = {goal_, view};
  behaviours_.progress.move(view, behaviours_.params);
  // What the body turns in front of a gap is none of the boundary.
  if (phase_ != Phase::gap) loop_.move(view);
  follower_.move(view);
  approach_.observe(view, target_, phase_ == Phase::approach, decision_);
  act(view);
  if (gives_way(view)) {
    otherwise_ = decision_.why;
    decision_.why = Why::something_moves;
  }
}

bool BoundaryPlanner::gives_way(const View& view) const noexcept {
  if (phase_ == Phase::evade) return true;
  if (!view.local_grid->doubting()) return false;
  switch (phase_) {
    case Phase::survey:
    case Phase::over: break;
    case Phase::approach: return approach_.yields(view, decision_);
    case Phase::choose_side: return true;
    case Phase::boundary: return follower_.yields(view);
    case Phase::evade: break;
    case Phase::gap:
    case Phase::arrive: return view.held_back();
  }
  return false;
}

void BoundaryPlanner::act(const View& view) noexcept {
  const Why exhausted = behaviours_.progress.exhausted(behaviours_.params.boundary.length_budget);
  if (exhausted != Why::none) {
    phase_ = Phase::over;
    finish(Mode::gave_up, exhausted, Outcome::gave_up);
    return;
  }
  if (phase_ != Phase::arrive && arrives(target_.to, target_.distance, view, behaviours_.params)) {
    on(Event::at_goal);
    decision_.manoeuvre = stop();
  }
  const bool threatened = evasion_.threatened(view, behaviours_.params);
  if (threatened &&
      (phase_ == Phase::approach || phase_ == Phase::choose_side || phase_ == Phase::boundary)) {
    evasion_.begin();
    on(Event::threatened);
  }
  if (!threatened && phase_ == Phase::evade) begin_approach(Event::passed);
  switch (phase_) {
    case Phase::survey: survey(view); break;
    case Phase::approach: approach(view); break;
    case Phase::choose_side: choose_side(view); break;
    case Phase::boundary:
      if (boundary(view)) approach(view);
      break;
    case Phase::evade: decision_.manoeuvre = evasion_.step(view, behaviours_.params); break;
    case Phase::gap: gap(view); break;
    case Phase::arrive: arrive(view); break;
    case Phase::over: break;
  }
}

void BoundaryPlanner::on(Event event) noexcept { behaviours_.change(kTransitions, event, phase_, decision_); }

void BoundaryPlanner::end(Event event, Outcome outcome) noexcept {
  on(event);
  finish(decision_.mode, decision_.why, outcome);
}

void BoundaryPlanner::arrive(const View& view) noexcept {
  if (!view.settled) return;
  if (is_goal(target_.distance)) {
    end(Event::settled, Outcome::reached);
  } else {
    begin_approach(Event::slid_off);
  }
}

void BoundaryPlanner::survey(const View& view) noexcept {
  if (survey_.step(view, target_.direction(), behaviours_.params, decision_.manoeuvre)) on(Event::surveyed);
}

void BoundaryPlanner::approach(const View& view) noexcept {
  if (view.sighted && decision_.why == Why::narrow) {
    slits_.look(view, view.pose.heading);
    slits_.look(view, target_.direction());
  }
  if (approach_.blocked() && (try_door(view, view.pose.heading) || try_door(view, target_.direction())))
    return;
  if (approach_.step(view, target_, wall_, decision_)) return;
  if (approach_.refuted()) {
    end(Event::refuted, Outcome::unreachable);
  } else {
    begin_side_search(view);
  }
}

void BoundaryPlanner::begin_side_search(const View& view) noexcept {
  const Angle target = target_.direction();
  loop_.begin(view, behaviours_.params);
  other_way_ = false;
  slits_.begin_loop();
  if (behaviours_.progress.travel_mm() - left_edge_mm_ < behaviours_.mm(kKeepSide)) {
    side_search_.begin_on(target, opposite(wall_));
  } else {
    side_search_.begin(target, (view.pose.heading - target).wrapped() > 0 ? Side::left : Side::right);
  }
  on(Event::blocked);
}

void BoundaryPlanner::choose_side(const View& view) noexcept {
  Twist twist;
  if (view.sighted) slits_.look(view, view.pose.heading);
  if ((approach_.has_guide() || slits_.next_in_wall(view)) && try_door(view, target_.direction())) return;
  const bool over = side_search_.step(view, twist);
  decision_.manoeuvre = cruise(twist, behaviours_.params);
  if (!over) return;
  if (!side_search_.found()) {
    on(Event::no_exit);
    follower_.begin_at_wall(view, target_.direction(), wall_, decision_);
    return;
  }
  wall_ = opposite(side_search_.side());
  follower_.begin_along(side_search_.heading(), wall_);
  on(Event::exit);
  decision_.why = wall_ == Side::right ? Why::exit_left : Why::exit_right;
}

bool BoundaryPlanner::boundary(const View& view) noexcept {
  if (follower_.follows() && view.sighted) {
    const LoopDetector::Evidence evidence =
        approach_.has_guide() ? LoopDetector::Evidence::place : LoopDetector::Evidence::turning;
    // The map refutes the rest of the second loop, which was for the slits.
    const bool refuted = other_way_ && approach_.knows_no_way() && !knows_slit();
    const bool expects = slits_.expects();
    const bool closed = loop_.closed(view, evidence);
    // The rest of the loop is driven for slits: it is no evidence.
    if (closed && !expects) parts_ = loop_.is_seen() && loop_.may_part(began_, goal_.at, wall_);
    if (refuted || ((closed || expects) && !slits_.expected(view))) {
      go_the_other_way(view);
      return false;
    }
    if (loop_.strays(view, evidence)) {
      escape(view);
      return false;
    }
    if (may_leave(view)) {
      left_edge_mm_ = behaviours_.progress.travel_mm();
      begin_approach(Event::nearer);
      return true;
    }
    slits_.look_on_boundary(view, wall_);
    if ((other_way_ || slits_.expects()) && try_slit(view)) return false;
  }
  if (!follower_.step(view, decision_)) end(Event::stuck, Outcome::gave_up);
  return false;
}

void BoundaryPlanner::gap(const View& view) noexcept {
  switch (passage_.step(view, decision_)) {
    case GapPassage::Result::under_way: break;
    case GapPassage::Result::through:
      // Only a passage that brings the body nearer to the goal than ever before cannot repeat without end.
      if (target_.distance >= approach_.closest() - for_body(behaviours_.params, kNearer))
        slits_.end_attempt();
      sought_ = false;
      approach_.pass();
      approach_.measure_anew(view, target_.distance);
      begin_approach(Event::through);
      break;
    case GapPassage::Result::failed:
      if (passage_.promised()) {
        passage_.count_failure();
        begin_approach(Event::no_door);
        break;
      }
      slits_.end_attempt();
      on(Event::too_narrow);
      follower_.begin_at_wall(view, passage_.came_along(), wall_, decision_);
      break;
  }
}

bool BoundaryPlanner::try_slit(const View& view) noexcept {
  if (!slits_.at_hand(view)) return false;
  on(Event::slit);
  passage_.begin(view, slits_.take(view), false, decision_);
  return true;
}

bool BoundaryPlanner::try_door(const View& view, Angle way) noexcept {
  if (passage_.failures() == kDoors || !slits_.at_hand(view)) return false;
  const Pose door = slits_.next(view);
  if (magnitude(door.heading - way) > kStraightOn.raw()) return false;
  if (passage_.failures() > 0 && slits_.taken_near(door.at)) return false;
  on(Event::slit);
  passage_.begin(view, slits_.take(view), true, decision_);
  return true;
}

void BoundaryPlanner::begin_approach(Event event) noexcept {
  approach_.begin();
  on(event);
}

bool BoundaryPlanner::may_leave(const View& view) const noexcept {
  if (target_.distance >= approach_.closest() - for_body(behaviours_.params, kNearer)) return false;
  const Angle target = target_.direction();
  const Reach& reach = view.local_grid->reach();
  const Way found = way(view, target, min(reach.probe, target_.distance), reach.planning);
  // Away from the wall, unknown ground is acceptable; on the wall's side it is most likely wall.
  const bool wall_side = (target - view.pose.heading).wrapped() * int64_t{sign(wall_)} > 0;
  return found == Way::free || (found == Way::unknown && !wall_side);
}

void BoundaryPlanner::escape(const View& view) noexcept {
  // A held body that turns on the spot has followed no boundary.
  if (!behaviours_.progress.rests() && ++escapes_ > kEscapes) {
    // A loop that parts nothing proves nothing, nor does one around unknown ground.
    if (loop_.is_seen() && (approach_.has_guide() || loop_.may_part(began_, goal_.at, wall_))) {
      give_up_goal(view);
    } else {
      end(Event::stuck, Outcome::gave_up);
    }
    return;
  }
  approach_.measure_anew(view, target_.distance);
  wall_ = opposite(wall_);
  left_edge_mm_ = behaviours_.progress.travel_mm() + behaviours_.mm(kOtherSide);
  begin_approach(Event::wall_lost);
}

void BoundaryPlanner::give_up_goal(const View& view) noexcept {
  if (!approach_.doubt()) {
    end(Event::enclosed, Outcome::unreachable);
    return;
  }
  approach_.measure_anew(view, target_.distance);
  escapes_ = 0;
  begin_approach(Event::doubted);
}

void BoundaryPlanner::go_the_other_way(const View& view) noexcept {
  slits_.end_loop(view);
  if (other_way_ || (approach_.knows_no_way() && (sought_ || !knows_slit()))) {
    if (parts_) {
      give_up_goal(view);
    } else {
      escape(view);
    }
    return;
  }
  // A gap may be passable from only one side, so follow the boundary in the other direction.
  other_way_ = true;
  sought_ = approach_.knows_no_way();
  wall_ = opposite(wall_);
  const Angle back = view.pose.heading + 180_deg;
  loop_.begin(view, behaviours_.params);
  follower_.begin_at_wall(view, back, wall_, decision_);
  on(Event::closed);
}

}  // namespace whisker::planning
