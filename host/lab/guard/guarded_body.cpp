#include "host/lab/guard/guarded_body.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/control/wheel_drive.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "host/harness/run/spec.hpp"

namespace whisker::guard {
namespace {

constexpr double kStanding_mps = 1e-3;

std::int32_t micro(double value) {
  return static_cast<std::int32_t>(std::clamp(std::floor(value * 1e6 + 0.5), -2147483647.0, 2147483647.0));
}

sim::RobotSpec spec_of(const Scenario& scenario, bool fine) {
  sim::RobotSpec spec = robot_spec(scenario);
  if (fine) spec.period_s = 0.001;
  return spec;
}

}  // namespace

Velocity velocity(const Twist& twist) {
  return {Speed::from_raw(micro(twist.forward_mps)), AngularRate::from_raw(micro(twist.turning_radps))};
}

GuardedBody::GuardedBody(const Scenario& scenario, const sim::WorldView& world, const Wiring& wiring,
                         bool fine)
    : fine_(fine),
      params_(scenario.robot),
      plant_(world, spec_of(scenario, fine), noise_spec(scenario.noise), scenario.seed, scenario.start),
      board_(plant_),
      wheels_(board_),
      loss_(scenario.robot) {
  wire(wiring);
}

void GuardedBody::wire(const Wiring& wiring) {
  wiring_ = wiring;
  next_params_ = params_;
  next_params_.guard = wiring.guard;
  next_table_ = wiring.table;
  make_guard();
  if (wiring.vouched_m > 0) guard_->vouch(Length::from_raw(micro(wiring.vouched_m)));
  bare_ = {};
  hash_ = {};
}

void GuardedBody::make_guard() {
  // The guard keeps a reference to its parameters.
  guard_.reset();
  params_ = next_params_;
  guard_.emplace(board_, wheels_, params_, &board_);
  if (next_table_ != nullptr) guard_->assist_by(*next_table_);
  put_down_ = plant_.pose();
}

bool GuardedBody::play(const Event& e) {
  switch (e.kind) {
    case EventKind::goal: return true;
    case EventKind::reset:
      if (wiring_.guarded) guard_->reset();
      return wiring_.guarded;
    case EventKind::param: return apply_param(e, next_params_);
    case EventKind::table: {
      const auto* const table = e.file.empty() ? &fuzzy::kResponseTable : e.table;
      if (table != nullptr) next_table_ = table;
      return table != nullptr;
    }
    case EventKind::frames_lost:
      away_ = sent();
      loss_.lose(e.for_s);
      return true;
    case EventKind::restart:
      away_ = sent();
      loss_.restart();
      return true;
    case EventKind::cancel:
    case EventKind::correct:
    case EventKind::place: break;
  }
  return false;
}

bool GuardedBody::regain() {
  const LinkLoss::Step step = loss_.step(away_, plant_);
  is_away_ = step == LinkLoss::Step::hold || step == LinkLoss::Step::brake;
  if (step == LinkLoss::Step::brake) away_ = loss_.slowed(away_);
  if (is_away_) plant_.command(away_);
  if (is_away_ || step == LinkLoss::Step::up) return !is_away_;
  if (step == LinkLoss::Step::restart) make_guard();
  if (step == LinkLoss::Step::resume) guard_->reset();
  bare_ = {};
  if (step == LinkLoss::Step::resume || (step == LinkLoss::Step::back && loss_.held())) {
    wheels_.refuse();
    guard_->braked_elsewhere();
  }
  return true;
}

void GuardedBody::command(const Twist& twist) {
  twist_ = twist;
  guard_->command(velocity(twist), now());
}

Moment GuardedBody::tick() {
  Moment moment{plant_.time(), plant_.pose(), plant_.v_left(), plant_.v_right(), plant_.ranges(), twist_};
  const bool heard = regain();
  if (wiring_.guarded) {
    if (heard) guard_->tick(now());
    moment.status = &guard_->status();
    moment.grid = &guard_->local_grid();
    hash_.add(sent());
  } else if (heard) {
    without_guard();
  }
  moment.command = sent();
  return moment;
}

void GuardedBody::without_guard() {
  const Velocity asked = velocity(twist_);
  const Speed turning = asked.turning * (params_.body.track / 2);
  const WheelPair want = inverse_kinematics(asked.forward, turning, params_.wheels.max_speed);
  bare_ = slew(bare_, want, params_.wheels.max_acceleration * milliseconds(gap_ms_));
  plant_.command(sent());
}

void GuardedBody::pass(int gap_ms) {
  gap_ms_ = gap_ms;
  now_ms_ += static_cast<std::uint32_t>(gap_ms);
  for (int i = fine_ ? gap_ms : 1; i > 0 && !plant_.in_contact(); --i) plant_.advance();
}

bool GuardedBody::stands() const {
  return std::fabs(plant_.v_left()) < kStanding_mps && std::fabs(plant_.v_right()) < kStanding_mps;
}

hal::WheelSpeeds GuardedBody::sent() const {
  if (is_away_) return away_;
  return wiring_.guarded ? guard_->status().command : control::to_wire(bare_);
}

}  // namespace whisker::guard
