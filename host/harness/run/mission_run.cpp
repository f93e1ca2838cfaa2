#include "host/harness/run/mission_run.hpp"

#include <cmath>

#include "host/harness/run/make_record.hpp"
#include "host/harness/run/narrowest_gap.hpp"

namespace whisker {
namespace {

std::optional<Verdict> verdict_of(const Status& status, const Pilot& pilot) {
  if (status.health.fault != Fault::none || pilot.trouble() != nullptr) {
    const bool stands = status.command.left == 0 && status.command.right == 0;
    return stands ? std::optional(Verdict::fault) : std::nullopt;
  }
  return whisker::verdict_of(status.decision.outcome);
}

const char* detail_of(Verdict verdict, const Status& status, const Pilot& pilot) {
  if (verdict == Verdict::off_goal) return "at_goal_by_its_estimate";
  if (verdict == Verdict::fault && status.health.fault == Fault::none) return pilot.trouble();
  return verdict == Verdict::fault ? name(status.health.fault) : planning::name(status.decision.why);
}

/// An event has ended it, and the wheels are commanded to stand.
bool has_no_mission(const Status& status) {
  return status.decision.outcome == planning::Outcome::none && status.health.fault == Fault::none &&
         status.command.left == 0 && status.command.right == 0;
}

double length(sim::Vec2 v) { return std::sqrt(sim::dot(v, v)); }

TickRecord record_of(const sim::Plant& plant, const Pilot& pilot, const Status& status,
                     const hal::RangeReadings& ranges, double t_s) {
  TickRecord r = make_record(status, pilot.guide(), ranges, t_s);
  r.inside = pilot.sees_inside();
  add_truth(plant, r);
  r.pressed = plant.bumper().pressed;
  return r;
}

}  // namespace

MissionRun::MissionRun(const Scenario& scenario, sim::Plant& plant, Pilot& pilot)
    : scenario_(&scenario),
      plant_(&plant),
      pilot_(&pilot),
      period_ms_(static_cast<std::uint64_t>(scenario.robot.safety.period.raw())) {}

void MissionRun::decide() {
  const std::uint64_t now_ms = ticks_ * period_ms_;
  t_s_ = static_cast<double>(now_ms) / 1000.0;
  ranges_ = plant_->ranges();
  status_ = &pilot_->tick(Time::from_raw(static_cast<std::uint32_t>(now_ms)));
  hash_.add(status_->command);
  ++ticks_;
  verdict_ = mission_to_come_ ? std::nullopt : verdict_of(*status_, *pilot_);
  if (verdict_) {
    verdict_ = judged(*verdict_, distance_left(), scenario_->goal.tolerance_m);
    detail_ = detail_of(*verdict_, *status_, *pilot_);
  } else if (static_cast<double>(now_ms + period_ms_) / 1000.0 > scenario_->time_limit_s) {
    verdict_ = Verdict::gave_up;
    detail_ = "time_limit";
  } else if (!scenario_->events.empty() && !mission_to_come_ && has_no_mission(*status_)) {
    verdict_ = Verdict::gave_up;
    detail_ = "no_goal";
  }
}

void MissionRun::move() {
  plant_->advance();
  if (!plant_->in_contact()) return;
  verdict_ = Verdict::contact;
  detail_ = planning::name(status_->decision.mode);
  ranges_ = plant_->ranges();
  t_s_ = static_cast<double>(ticks_ * period_ms_) / 1000.0;
}

void MissionRun::resume() {
  if (verdict_ == Verdict::contact || verdict_ == Verdict::fault) return;
  verdict_.reset();
  detail_ = "";
}

double MissionRun::distance_left() const { return length(scenario_->goal.at - plant_->pose().at); }

std::optional<double> MissionRun::believed_distance() const {
  const auto pose = pilot_->sees_inside() ? std::optional(status_->pose) : pilot_->estimate();
  if (!pose) return std::nullopt;
  return length(scenario_->goal.at - sim::Vec2{pose->at.x.raw() * 1e-6, pose->at.y.raw() * 1e-6});
}

TickRecord MissionRun::record() const { return record_of(*plant_, *pilot_, *status_, ranges_, t_s_); }

RunResult MissionRun::result() const {
  RunResult result;
  result.verdict = verdict_.value_or(result.verdict);
  result.detail = detail_;
  result.time_s = verdict_ == Verdict::contact ? plant_->contact_time() : t_s_;
  result.path_m = plant_->path_length();
  result.final_distance_m = distance_left();
  result.believed_distance_m = believed_distance();
  result.min_clearance_m = std::fmin(plant_->min_clearance(), kEmptyWorldClearance);
  result.bumps = plant_->bumps();
  result.ranges = pilot_->ranges();
  if (result.verdict == Verdict::unreachable && pilot_->local_grid() != nullptr) {
    result.unreachable_above_m = narrowest_gap_m(scenario_->robot);
  }
  result.sigma = pilot_->sigma();
  result.goal_tolerance_m = scenario_->goal.tolerance_m;
  result.ticks = ticks_;
  result.hash = hash_.value();
  return result;
}

}  // namespace whisker
