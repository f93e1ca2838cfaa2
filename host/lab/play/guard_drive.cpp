#include "host/lab/play/guard_drive.hpp"

#include "host/harness/run/make_record.hpp"

namespace whisker::play {
namespace {

Fitted fitted(bool on) { return on ? Fitted::yes : Fitted::no; }

}  // namespace

GuardDrive::GuardDrive(const Scenario& scenario, const Switches& switches,
                       const fuzzy::Bilinear::Table& table)
    : scenario_(scenario),
      table_(table),
      world_(std::make_unique<SimWorld>(scenario_)),
      view_(world_->view()),
      switches_(switches),
      body_(scenario_, view_, wiring()) {
  note(scenario_.start.at, reason());
}

guard::Wiring GuardDrive::wiring() const {
  guard::Wiring wiring{switches_.guarded, scenario_.robot.guard, 0, &table_};
  wiring.guard.nods = fitted(switches_.nods);
  wiring.guard.assist = fitted(switches_.assist);
  return wiring;
}

void GuardDrive::set(const Switches& switches) {
  switches_ = switches;
  rewires_ = true;
}

void GuardDrive::advance(int ticks) {
  const int period_ms = static_cast<int>(scenario_.robot.safety.period.raw());
  for (; ticks > 0 && !over(); --ticks) {
    if (rewires_ && body_.stands()) {
      body_.wire(wiring());
      rewires_ = false;
    }
    body_.command(rewires_ ? guard::Twist{} : twist_);
    body_.tick();
    body_.pass(period_ms);
    ++ticks_;
    note(body_.plant().pose().at, reason());
  }
}

void GuardDrive::change(const Scenario& scenario) {
  adopt_world(scenario_, scenario);
  world_ = std::make_unique<SimWorld>(scenario_);
  view_ = world_->view();
}

TickRecord GuardDrive::record() const {
  const sim::Plant& plant = body_.plant();
  TickRecord r;
  r.t_s = plant.time();
  r.ranges = plant.ranges();
  r.command = body_.sent();
  add_truth(plant, r);
  const bool guarded = body_.wiring().guarded;
  add_estimate(guarded ? in_world(body_.put_down(), grid_pose()) : plant.pose(), r);
  if (guarded && body_.status().sigma_known) r.sigma = body_.status().sigma;
  return r;
}

RunResult GuardDrive::result() const {
  const sim::Plant& plant = body_.plant();
  RunResult r = way_of(plant, scenario_, ticks_);
  r.verdict = plant.in_contact() ? Verdict::contact : body_.faulted() ? Verdict::fault : Verdict::gave_up;
  r.time_s = plant.in_contact() ? plant.contact_time() : plant.time();
  r.hash = body_.hash();
  return r;
}

Fault GuardDrive::fault() const { return body_.wiring().guarded ? body_.status().health.fault : Fault::none; }

Pose GuardDrive::grid_pose() const { return body_.wiring().guarded ? body_.status().pose : Pose{}; }

/// By GuardReason; the number after the last one without the guard.
int GuardDrive::reason() const {
  return body_.wiring().guarded ? static_cast<int>(body_.status().reason) : kGuardReasons;
}

}  // namespace whisker::play
