#include "firmware/apps/can/remote_guard.hpp"

namespace whisker::can_app {
namespace {

static_assert(sizeof can::kGuardReasonWords / sizeof *can::kGuardReasonWords == kGuardReasons);

constexpr int32_t kForwardUnit = 100;   // um/s
constexpr int32_t kTurningUnit = 1000;  // urad/s

int16_t in_units(int32_t raw, int32_t unit) noexcept {
  const int32_t units = raw / unit;
  return saturate16(units < -INT16_MAX ? -INT16_MAX : units);
}

uint8_t percent(Q14 share) noexcept { return static_cast<uint8_t>(int32_t{share.raw()} * 100 / Q14::kOne); }

}  // namespace

void RemoteGuard::execute(can::Order order, const Params& params) noexcept {
  if (order == can::Order::start) {
    params_ = params;
    board_ = RemoteBoard{};
    guard_ = &room_.make<Guard>(board_, board_, params_, &board_);
    if (table_ != nullptr) guard_->assist_by(*table_);
  } else if (ready()) {
    guard_->reset();
  }
}

const GuardStatus& RemoteGuard::step(const can::InputSet& set, bool braked) noexcept {
  board_.on_frame(set, braked);
  if (braked) guard_->braked_elsewhere();
  return guard_->tick(time_of(set));
}

Velocity velocity_of(const can::VelocityCommand& command) noexcept {
  return {Speed::from_raw(command.forward * kForwardUnit),
          AngularRate::from_raw(command.turning * kTurningUnit)};
}

can::NavStatus nav_status(const GuardStatus& s) noexcept {
  const bool failed = s.health.fault != Fault::none;
  can::NavStatus told;
  told.outcome = failed ? planning::Outcome::gave_up : planning::Outcome::running;
  told.state = failed ? planning::Mode::stopped : planning::Mode::steering;
  told.why = failed ? planning::Why::fault : planning::Why::table;
  told.fault = static_cast<uint8_t>(s.health.fault);
  return told;
}

can::GuardReport guard_report(const GuardStatus& s) noexcept {
  can::GuardReport report;
  report.reason = static_cast<uint8_t>(s.reason);
  report.asked_forward = in_units(s.asked.forward.raw(), kForwardUnit);
  report.asked_turning = in_units(s.asked.turning.raw(), kTurningUnit);
  report.granted_forward = percent(s.forward);
  report.granted_turning = percent(s.turning);
  return report;
}

}  // namespace whisker::can_app
