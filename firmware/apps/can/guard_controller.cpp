#include "firmware/apps/can/guard_controller.hpp"

namespace whisker::can_app {
namespace {

constexpr uint32_t kIdleReport_ms = 100;

}  // namespace

bool GuardController::poll(uint32_t now_ms) noexcept {
  node_.poll(now_ms);
  can::Order order = can::Order::cancel;
  can::Mission mission;
  if (node_.take_order(order, mission)) begin(order);
  can::InputSet set;
  if (!guard_.ready() || !node_.take_set(set)) {
    if (now_ms - told_at_ >= kIdleReport_ms) tell({}, now_ms);
    return false;
  }
  take_wishes(time_of(set), now_ms);
  status_ = guard_.step(set, node_.braked());
  still_ = still_ && status_.command.left == 0 && status_.command.right == 0;
  answer(set);
  tell(guard_report(status_), now_ms);
  return true;
}

void GuardController::begin(can::Order order) noexcept {
  Params params = node_.params();
  params.guard.command_timeout = min(params.guard.command_timeout, longest_command_);
  guard_.execute(order, params);
  inbox_.disarm();
  still_ = true;
  vouched_ = false;
}

/// A Vouch that comes late, when the body may have left its place, does not count.
void GuardController::take_wishes(Time now, uint32_t now_ms) noexcept {
  can::VouchRequest vouch;
  if (inbox_.take(vouch) && still_) {
    guard_.guard().vouch(millimetres(vouch.radius_mm));
    vouched_ = true;
  }
  can::VelocityCommand velocity;
  uint32_t age_ms = 0;
  if (!inbox_.take(velocity, now_ms, age_ms)) return;
  // In lockstep, the time of the sets is not that of the clock.
  const auto age = node_.lockstep() ? Duration{} : milliseconds(static_cast<int32_t>(age_ms));
  guard_.guard().command(velocity_of(velocity), now - age);
}

void GuardController::answer(const can::InputSet& set) noexcept {
  node_.publish_trust(trust_report(status_.health.ranges), false);
  if (status_.sigma_known) node_.publish_sigma(sigma_report(status_), false);
  if (set.has_fix) node_.answer_fix(fix_reply(can::FixStatus::refused, status_.health));
  node_.answer(status_.command, nav_status(status_));
  const bool failed = status_.health.fault != Fault::none;
  node_.report(failed ? uint16_t{can::Error::core_fault} : uint16_t{0},
               static_cast<uint8_t>(status_.health.fault));
}

void GuardController::tell(can::GuardReport report, uint32_t now_ms) noexcept {
  report.vouched = vouched_ ? 1 : 0;
  report.armed = inbox_.armed() ? 1 : 0;
  node_.publish_guard(report);
  told_at_ = now_ms;
}

}  // namespace whisker::can_app
