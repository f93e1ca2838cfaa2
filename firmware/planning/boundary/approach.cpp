#include "firmware/planning/boundary/approach.hpp"

#include "firmware/planning/candidate_headings.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::planning {
namespace {

constexpr int32_t kCheapTurn = static_cast<int32_t>((25_deg).raw());
constexpr Q14 kHindered = Q14::ratio(9, 10);

Angle limited(Angle turn, int32_t most) noexcept {
  const int32_t wrapped = turn.wrapped();
  return Angle::from_raw(static_cast<uint32_t>(wrapped > most ? most : wrapped < -most ? -most : wrapped));
}

}  // namespace

void Approach::start(const View& view, const Goal& goal) noexcept {
  closest_.reset();
  guided_ = refuted_ = false;
  begin();
  if (guide_ != nullptr) guide_->start(view, goal);
}

void Approach::move_goal(Vec at) noexcept {
  closest_.follow(at);
  if (guide_ != nullptr) guide_->move_goal(at);
}

void Approach::observe(const View& view, const Target& target, bool active, Decision& decision) noexcept {
  if (guide_ != nullptr) guide_->observe(view);
  if (!active) decision.bend = Angle{};
  if (!view.sighted) return;
  const Angle course = !active ? view.pose.heading : guided_ ? aim_ : target.direction();
  const Angle bend = law_.deflect(view, course, behaviours_.params, decision);
  decision.bend = active ? bend : Angle{};
}

void Approach::ponder(const View& view) noexcept {
  if (guide_ != nullptr) guide_->ponder(view);
}

void Approach::begin() noexcept {
  phase_ = Phase::drive;
  course_.reset();
  behaviours_.stuck.reset();
}

bool Approach::step(const View& view, const Target& target, Side& wall, Decision& decision) noexcept {
  switch (phase_) {
    case Phase::drive: return drive(view, target, wall, decision);
    case Phase::scan: return scan(view, decision);
    case Phase::brake: return brake(view, decision);
  }
  return true;
}

bool Approach::brake(const View& view, Decision& decision) noexcept {
  if (view.settled) on(Event::settled, decision);
  return true;
}

void Approach::on(Event event, Decision& decision) noexcept {
  behaviours_.change(kTransitions, event, phase_, decision);
}

bool Approach::drive(const View& view, const Target& target, Side& wall, Decision& decision) noexcept {
  if (target.distance < closest()) measure_anew(view, target.distance);
  Vec to = target.to;
  if (guide_ != nullptr && advised(view, target.distance, to, decision)) return !refuted_;
  aim_ = bearing(to);
  if ((view.sighted || course_.searches()) &&
      !course_.choose(view, to, decision.bend, behaviours_.params, wall, decision)) {
    return detour(view, target.distance, decision);
  }
  Angle heading = course_.heading();
  const Length length = min(view.local_grid->reach().probe, norm(to));
  if (behaviours_.stalled(view)) {
    // The looks that this place needs are over: another one would see what the last one has seen.
    if (behaviours_.progress.rests()) return detour(view, target.distance, decision);
    on(Event::unknown, decision);
    behaviours_.scan.begin(heading, length, decision.manoeuvre);
    return true;
  }
  const Angle past = view.local_grid->reach().past;
  // A small turn may show unseen ground. A body that must sweep looks ahead, others once the guard limits it.
  if (view.granted < kHindered || past != Angle{}) {
    const Unseen rest = unseen(view, heading, length, heading, behaviours_.params);
    heading += limited(rest.cells == 0           ? Angle{}
                       : rest.turn.wrapped() < 0 ? rest.turn - past
                                                 : rest.turn + past,
                       kCheapTurn);
  }
  decision.manoeuvre = behaviours_.drive(view, heading);
  return true;
}

bool Approach::detour(const View& view, Length distance, Decision& decision) noexcept {
  if (guided_ && guide_->refuse(view)) {
    course_.reset();
    on(Event::refused, decision);
    decision.manoeuvre = stop();
    return true;
  }
  if (guided_) measure_anew(view, distance);
  guided_ = false;
  return false;
}

bool Approach::advised(const View& view, Length distance, Vec& to, Decision& decision) noexcept {
  const GlobalPlanner::Advice advice = guide_->advise(view, distance, to);
  // The guide may have led away from the goal, so progress is measured again from here.
  if (guided_ && advice == GlobalPlanner::Advice::none) measure_anew(view, distance);
  guided_ = advice != GlobalPlanner::Advice::none;
  refuted_ = advice == GlobalPlanner::Advice::no_way;
  if (refuted_) return true;
  if (advice != GlobalPlanner::Advice::wait) return false;
  decision.manoeuvre = stop();
  behaviours_.stuck.reset();
  return true;
}

bool Approach::scan(const View& view, Decision& decision) noexcept {
  if (!behaviours_.scan.step(view, behaviours_.params, decision.manoeuvre)) return true;
  decision.looked = true;
  if (behaviours_.scan.in_vain()) return false;
  on(Event::scanned, decision);
  return true;
}

bool Approach::yields(const View& view, const Decision& decision) const noexcept {
  switch (phase_) {
    case Phase::drive: return view.held_back() || decision.why == Why::narrow;
    case Phase::scan: return true;
    case Phase::brake: break;
  }
  return view.held_back();
}

}  // namespace whisker::planning
