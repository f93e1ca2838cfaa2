#include "host/harness/run/event_pilot.hpp"

#include "host/harness/run/spec.hpp"

namespace whisker {

EventPilot::EventPilot(const Scenario& scenario, PlannerKind planner, sim::Plant& plant)
    : plant_(plant), fixes_(scenario), loss_(scenario.robot), next_(scenario), kind_(planner) {
  next_.noise.fix_every_m = 0;  // fixes are taken here
  start();
}

void EventPilot::start() {
  core_.reset();
  driven_ = std::make_unique<const Scenario>(next_);
  core_ = std::make_unique<CorePilot>(*driven_, make_recorded_planner(kind_, driven_->robot), plant_);
  changed_ = false;
}

const Status& EventPilot::tick(Time now) {
  auto fix = fixes_.take(plant_);
  switch (loss_.step(away_.command, plant_)) {
    case LinkLoss::Step::up: break;
    case LinkLoss::Step::hold: return stay(false);
    case LinkLoss::Step::brake: return stay(true);
    case LinkLoss::Step::back:
      if (loss_.held()) core_->note_braked();
      break;
    case LinkLoss::Step::resume:
      core_->robot().reset();
      core_->set_goal(fixed_goal(next_.goal));
      core_->note_braked();
      break;
    case LinkLoss::Step::restart:
      next_.start = plant_.pose();
      start();
      break;
  }
  if (fix_) fix = fix_;
  fix_.reset();
  const Status& status = core_->tick(now);
  if (fix) core_->robot().correct(fix->pose, fix->sigma);
  return status;
}

/// A tick without the robot.
const Status& EventPilot::stay(bool brakes) {
  if (brakes) away_.command = loss_.slowed(away_.command);
  plant_.command(away_.command);
  return away_;
}

bool EventPilot::lose(double for_s) {
  away_ = core_->status();
  loss_.lose(for_s);
  return true;
}

bool EventPilot::restart() {
  away_ = core_->status();
  away_.decision.outcome = planning::Outcome::running;
  away_.health = {};
  loss_.restart();
  return true;
}

bool EventPilot::aim(const Goal& goal) {
  if (!changed_ && faulted()) return false;
  next_.goal = goal;
  if (changed_) return restart();
  core_->set_goal(fixed_goal(goal));
  return true;
}

bool EventPilot::change(bool changed) {
  changed_ = changed_ || changed;
  return changed;
}

bool EventPilot::choose_table(const Event& event) {
  const fuzzy::Engine::Table* const table = event.file.empty() ? &fuzzy::kDefaultTable : event.table;
  if (table == nullptr || is_baseline(kind_)) return false;
  kind_.table = table;
  return true;
}

bool EventPilot::play(const Event& e) {
  Robot& robot = core_->robot();
  switch (e.kind) {
    case EventKind::goal: return aim(e.goal);
    case EventKind::cancel:
      if (!faulted()) robot.cancel();
      return !faulted();
    case EventKind::correct: fix_ = fix_of(e, plant_.pose()); return true;
    case EventKind::place: return robot.place(pose_of(e, plant_.pose()));
    case EventKind::reset: robot.reset(); return true;
    case EventKind::param: return change(apply_param(e, next_.robot));
    case EventKind::table: return change(choose_table(e));
    case EventKind::frames_lost: return lose(e.for_s);
    case EventKind::restart: return restart();
  }
  return false;
}

}  // namespace whisker
