#include "firmware/planning/boundary/boundary_follower.hpp"

#include "firmware/planning/boundary/wall_following.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::planning {
namespace {

constexpr Length kCommit = 60_mm;
constexpr Length kRefused = 5_mm;  // of the commitment: less travel than this means that the guard refused it
constexpr int8_t kRefusals = 10;
constexpr Length kOpeningEvery = 100_mm;
constexpr Length kSlitEvery = 20_mm;

}  // namespace

void BoundaryFollower::begin_along(Angle heading, Side wall) noexcept {
  start(Phase::turn, wall);
  heading_ = heading;
  searched_ = false;
}

void BoundaryFollower::begin_beside(const View& view, Angle blocked, Side wall, Decision& decision) noexcept {
  start(Phase::brake, wall);
  search_.begin(blocked, view.pose, wall);
  decision.manoeuvre = stop();
}

void BoundaryFollower::begin_at_wall(const View& view, Angle ahead, Side wall, Decision& decision) noexcept {
  start(Phase::brake, wall);
  search_.begin_at_wall(ahead, view.pose, wall);
  decision.manoeuvre = stop();
}

void BoundaryFollower::start(Phase phase, Side wall) noexcept {
  phase_ = phase;
  wall_ = wall;
  behaviours_.stuck.reset();
}

bool BoundaryFollower::step(const View& view, Decision& decision) noexcept {
  switch (phase_) {
    case Phase::brake:
      if (view.settled) on(Event::settled, decision);
      break;
    case Phase::search: search(view, decision); break;
    case Phase::scan: scan(view, decision); break;
    case Phase::turn: turn(view, decision); break;
    case Phase::follow: follow(view, decision); break;
    case Phase::retreat: return retreat(view, decision);
  }
  return true;
}

bool BoundaryFollower::yields(const View& view) const noexcept {
  switch (phase_) {
    case Phase::search:
    case Phase::scan:
    case Phase::retreat: return true;
    case Phase::brake:
    case Phase::turn:
    case Phase::follow: break;
  }
  return view.held_back();
}

void BoundaryFollower::on(Event event, Decision& decision) noexcept {
  behaviours_.change(kTransitions, event, phase_, decision);
  if (phase_ == Phase::brake) decision.manoeuvre = stop();
}

void BoundaryFollower::search(const View& view, Decision& decision) noexcept {
  decision.mode = Mode::searching;
  HeadingSearch::Heading found;
  switch (search_.step(view, behaviours_.params, found)) {
    case HeadingSearch::Found::nothing: break;
    case HeadingSearch::Found::unseen:
      on(Event::unknown, decision);
      behaviours_.scan.begin(found.angle, found.length, decision.manoeuvre);
      break;
    case HeadingSearch::Found::free:
      heading_ = found.angle;
      searched_ = true;
      on(Event::free, decision);
      break;
    case HeadingSearch::Found::none: on(Event::none_free, decision); break;
  }
}

void BoundaryFollower::scan(const View& view, Decision& decision) noexcept {
  if (!behaviours_.scan.step(view, behaviours_.params, decision.manoeuvre)) return;
  decision.looked = true;
  if (behaviours_.scan.in_vain()) search_.refuse();
  on(Event::scanned, decision);
}

void BoundaryFollower::turn(const View& view, Decision& decision) noexcept {
  if (!turn_by(heading_ - view.pose.heading, behaviours_.params, decision.manoeuvre)) return;
  commit_mm_ = travel_mm() + behaviours_.mm(kCommit);
  opening_mm_ = travel_mm();
  on(Event::facing, decision);
}

void BoundaryFollower::follow(const View& view, Decision& decision) noexcept {
  if (view.sighted && opening(view)) {
    search_from_wall(view);
    on(Event::opening, decision);
    return;
  }
  if (behaviours_.stalled(view)) {
    search_on(view, decision);
    return;
  }
  if (travel_mm() < commit_mm_) {
    decision.manoeuvre = behaviours_.drive(view, heading_);
    return;
  }
  decision.why = Why::edge;
  decision.manoeuvre = cruise(along_edge(view.moving_scan, wall_, behaviours_.params), behaviours_.params);
}

void BoundaryFollower::search_from_wall(const View& view) noexcept {
  search_.begin_at_wall(view.pose.heading, view.pose, wall_);
}

bool BoundaryFollower::opening(const View& view) noexcept {
  const bool thorough = search_.thorough();
  if (!thorough && !saw_slit_ && travel_mm() - slit_mm_ > behaviours_.mm(kSlitEvery)) {
    slit_mm_ = travel_mm();
    saw_slit_ = search_.slit(view, wall_, behaviours_.params);
  }
  if (travel_mm() - opening_mm_ <= behaviours_.mm(thorough ? kSlitEvery : kOpeningEvery)) return false;
  opening_mm_ = travel_mm();
  return search_.opening(view, wall_, behaviours_.params);
}

void BoundaryFollower::search_on(const View& view, Decision& decision) noexcept {
  const bool refused = searched_ && commit_mm_ - travel_mm() >= behaviours_.mm(kCommit - kRefused);
  if (!refused)
    refusals_ = 0;
  else if (refusals_ < kRefusals)
    ++refusals_;
  // After turning to the refused heading, the beams may show more on the wall's side.
  if (refusals_ < kRefusals) {
    search_from_wall(view);
  } else {
    search_.refuse();
  }
  on(Event::stuck, decision);
}

bool BoundaryFollower::retreat(const View& view, Decision& decision) noexcept {
  switch (search_.retreat(view, behaviours_.stalled(view), behaviours_.params, decision.manoeuvre)) {
    case HeadingSearch::Retreat::under_way: break;
    case HeadingSearch::Retreat::there:
      opening_mm_ = travel_mm();
      on(Event::back, decision);
      break;
    case HeadingSearch::Retreat::stuck:
      search_from_wall(view);
      on(Event::stuck, decision);
      break;
    case HeadingSearch::Retreat::lost: return false;
  }
  return true;
}

}  // namespace whisker::planning
