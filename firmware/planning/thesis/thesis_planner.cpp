#include "firmware/planning/thesis/thesis_planner.hpp"

#include "firmware/fuzzy/scale.hpp"
#include "firmware/planning/ground_inputs.hpp"

namespace whisker::planning {
namespace {

/// Maximum turn of an exit search to each side; the two sides together exclude the rear.
constexpr uint32_t kSearchLimit = (150_deg).raw();

/// The body moved if it is farther away than this.
constexpr Length kMoved = 10_mm;

}  // namespace

ThesisPlanner::ThesisPlanner(const Params& params, const fuzzy::Engine::Table& table) noexcept
    : params_(params), engine_(table) {
  probe_.configure(params);
  surroundings_.configure(params);
}

void ThesisPlanner::start(const View&) noexcept {
  phase_ = Phase::at_position;
  steps_ = 0;
  report(Mode::facing, Why::goal_set);
  decision_.manoeuvre = stop();
}

void ThesisPlanner::advance(const View& view) noexcept {
  if (view.sighted && !view.settled) set_pace(view);
  if (!view.settled && phase_ != Phase::scan) return;
  switch (phase_) {
    case Phase::at_position: arrive_at_position(view); break;
    case Phase::move: end_step(view); break;
    case Phase::scan: scan(view); break;
    case Phase::face_again: drive(rest_of_step(view)); break;
    case Phase::face:
      if (sees(view)) choose(view);
      break;
    case Phase::probe:
      if (sees(view)) probe(view);
      break;
    case Phase::search_left:
    case Phase::search_right:
      if (sees(view)) search(view);
      break;
  }
}

/// Its decisions use the echoes of this moment, as the thesis says. Between them, the ground sets the pace.
void ThesisPlanner::set_pace(const View& view) noexcept {
  decision_.inputs = ground_inputs(perception::nearest(view.moving_scan), *view.local_grid, view.pose.at,
                                   view.pose.heading, params_);
  decision_.response = engine_(decision_.inputs);
}

/// The guard cuts a step short at unseen ground: a scan may show that it is free. A second cut at the same
/// place counts as blocked.
void ThesisPlanner::end_step(const View& view) noexcept {
  if (!view.cut) {
    arrive_at_position(view);
    return;
  }
  if (!scanned_ || norm(view.pose.at - scanned_at_) > kMoved) {
    scanned_ = true;
    scanned_at_ = view.pose.at;
    enter(Phase::scan);
    report(Mode::looking, Why::unknown_ahead);
    scan_.begin(base_ + deflection(), min(rest_of_step(view), view.local_grid->reach().probe),
                decision_.manoeuvre);
    return;
  }
  scanned_ = false;
  if (planned_ - rest_of_step(view) > kMoved) {
    arrive_at_position(view);
  } else {
    deflect_or_end();
  }
}

void ThesisPlanner::scan(const View& view) noexcept {
  if (!scan_.step(view, params_, decision_.manoeuvre)) return;
  enter(Phase::face_again);
  turn_to(base_ + deflection());
}

bool ThesisPlanner::sees(const View& view) noexcept {
  decision_.looked = perception::usable(view.static_scan);
  if (!decision_.looked && decision_.mode == Mode::facing) decision_.mode = Mode::looking;
  if (decision_.looked) surroundings_.add(view.static_scan, view.pose.heading);
  return decision_.looked;
}

bool ThesisPlanner::step_is_free(const View& view) const noexcept {
  return probe_.free(view.static_scan, planned_) && surroundings_.allow(view.pose.heading, planned_);
}

void ThesisPlanner::arrive_at_position(const View& view) noexcept {
  const Vec to_goal = goal_.at - view.pose.at;
  if (is_goal(norm(to_goal))) {
    end(Mode::arrived, Why::at_goal, Outcome::reached);
    return;
  }
  if (steps_ >= derived::most_steps(params_)) {
    end(Mode::gave_up, Why::step_budget, Outcome::gave_up);
    return;
  }
  ++steps_;
  surroundings_.forget();
  target_ = bearing(to_goal);
  enter(Phase::face);
  decision_.mode = Mode::facing;
  turn_to(target_);
}

void ThesisPlanner::choose(const View& view) noexcept {
  const Length distance = norm(goal_.at - view.pose.at);
  const Length reach = params_.body.radius + params_.body.margin;
  const bool target_free =
      probe_.free(view.static_scan, min(derived::danger_range(params_) - reach, distance));
  if (target_free) {
    steer(view, distance);
  } else {
    follow_danger(view);
  }
}

void ThesisPlanner::steer(const View& view, Length distance) noexcept {
  const perception::Echo* const beam = view.static_scan.beam;
  const Length left = beam[hal::kLeft].distance;
  const Length front = beam[hal::kFront].distance;
  const Length right = beam[hal::kRight].distance;
  decision_.danger_count = 0;
  decision_.inputs = fuzzy::scale(left, front, right, params_.rangefinders.max_range);
  decision_.response = engine_(decision_.inputs);
  planned_ = min(derived::base_step(params_) * decision_.response.step, distance);

  const Angle turn = front >= distance ? Angle{} : scaled(derived::kBaseTurn, decision_.response.turn);
  base_ = target_ + turn;
  deflections_ = 0;
  // Deflect to the side of the table's output; if it is 0, to the side with more room.
  const int32_t lean = turn.wrapped();
  if (lean != 0) {
    side_ = lean > 0 ? 1 : -1;
  } else if (left != right) {
    side_ = left > right ? 1 : -1;
  }
  if (lean == 0) {
    decision_.why = Why::target_free;
    probe(view);
    return;
  }
  decision_.mode = Mode::steering;
  decision_.why = Why::table;
  enter(Phase::probe);
  turn_to(base_);
}

void ThesisPlanner::follow_danger(const View& view) noexcept {
  base_ = target_;
  planned_ = derived::small_step(params_);
  if (decision_.danger_count == 0) {
    decision_.danger_count = 1;
    decision_.mode = Mode::searching;
    decision_.why = Why::target_blocked;
    exit_left_ = 0;
    deflections_ = 0;
    side_ = 1;
    deflect(Phase::search_left);
    return;
  }
  if (decision_.danger_count != UINT8_MAX) ++decision_.danger_count;
  decision_.why = Why::same_side;
  deflections_ = 0;
  probe(view);
}

void ThesisPlanner::probe(const View& view) noexcept {
  if (step_is_free(view)) {
    left_ = view.pose.at;
    scanned_ = false;
    drive(planned_);
    return;
  }
  deflect_or_end();
}

void ThesisPlanner::deflect_or_end() noexcept {
  if (static_cast<uint64_t>(deflections_ + 1) * derived::kDelta.raw() >= (UINT64_C(1) << 32)) {
    end(Mode::gave_up, Why::no_exit, Outcome::gave_up);
    return;
  }
  decision_.mode = Mode::probing;
  if (decision_.danger_count == 0) decision_.why = Why::narrow;
  deflect(Phase::probe);
}

void ThesisPlanner::search(const View& view) noexcept {
  const bool left = phase_ == Phase::search_left;
  if (step_is_free(view)) {
    if (!left) {
      take_exit(-1, Why::exit_right);
      return;
    }
    exit_left_ = deflections_;
  }
  // The right side is searched only up to less than the turn to the left exit.
  const uint64_t limit = left || exit_left_ == 0
                             ? uint64_t{kSearchLimit}
                             : static_cast<uint64_t>(exit_left_ - 1) * derived::kDelta.raw();
  const uint64_t next = static_cast<uint64_t>(deflections_ + 1) * derived::kDelta.raw();
  if ((!left || exit_left_ == 0) && next <= limit) {
    deflect(phase_);
    return;
  }
  if (left && exit_left_ != 1) {
    deflections_ = 0;
    side_ = -1;
    deflect(Phase::search_right);
    return;
  }
  if (exit_left_ == 0) {
    end(Mode::gave_up, Why::no_exit, Outcome::gave_up);
    return;
  }
  deflections_ = exit_left_;
  take_exit(1, Why::exit_left);
}

void ThesisPlanner::take_exit(int32_t side, Why why) noexcept {
  side_ = side;
  decision_.why = why;
  enter(Phase::probe);
  turn_to(base_ + deflection());
}

Angle ThesisPlanner::deflection() const noexcept { return derived::kDelta * (deflections_ * side_); }

void ThesisPlanner::deflect(Phase phase) noexcept {
  enter(phase);
  ++deflections_;
  turn_to(base_ + deflection());
}

void ThesisPlanner::turn_to(Angle heading) noexcept {
  decision_.manoeuvre = {ManoeuvreKind::turn, heading, Length{}};
}

void ThesisPlanner::drive(Length length) noexcept {
  enter(Phase::move);
  decision_.mode = decision_.danger_count == 0 ? Mode::stepping : Mode::following;
  decision_.manoeuvre = {ManoeuvreKind::drive, base_ + deflection(), length};
}

Length ThesisPlanner::rest_of_step(const View& view) const noexcept {
  return planned_ - along(view.pose.at - left_, base_ + deflection());
}

/// The body is already at rest.
void ThesisPlanner::end(Mode mode, Why why, Outcome outcome) noexcept {
  finish(mode, why, outcome);
  decision_.manoeuvre = {};
}

}  // namespace whisker::planning
