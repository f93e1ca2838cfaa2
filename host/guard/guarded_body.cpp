#include "host/guard/guarded_body.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/control/wheel_drive.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "host/run/spec.hpp"

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
      board_(plant_) {
  wire(wiring);
}

void GuardedBody::wire(const Wiring& wiring) {
  wiring_ = wiring;
  // The guard keeps a reference to its parameters.
  guard_.reset();
  params_.guard = wiring.guard;
  guard_.emplace(board_, board_, params_, &board_);
  if (wiring.table != nullptr) guard_->assist_by(*wiring.table);
  if (wiring.vouched_m > 0) guard_->vouch(Length::from_raw(micro(wiring.vouched_m)));
  put_down_ = plant_.pose();
  bare_ = {};
  hash_ = {};
}

void GuardedBody::command(const Twist& twist) {
  twist_ = twist;
  guard_->command(velocity(twist), now());
}

Moment GuardedBody::tick() {
  Moment moment{plant_.time(), plant_.pose(), plant_.v_left(), plant_.v_right(), plant_.ranges(), twist_};
  if (wiring_.guarded) {
    moment.status = &guard_->tick(now());
    moment.grid = &guard_->local_grid();
    hash_.add(guard_->status().command);
  } else {
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
  return wiring_.guarded ? guard_->status().command : control::to_wire(bare_);
}

}  // namespace whisker::guard
