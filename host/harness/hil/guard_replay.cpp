#include "host/harness/hil/guard_replay.hpp"

namespace whisker::hil {

std::string difference_of(const can::WheelCommand& recorded, const char* who, const hal::WheelSpeeds& now) {
  if (recorded.speeds.left == now.left && recorded.speeds.right == now.right) return {};
  const auto words = [](const hal::WheelSpeeds& s) {
    return std::to_string(s.left) + " " + std::to_string(s.right);
  };
  return "tick " + std::to_string(recorded.tick) + ": recorded " + words(recorded.speeds) + ", the " + who +
         " says " + words(now) + " (0.1 mm/s)";
}

void GuardReplay::execute(can::Order order, const Params& params) {
  guard_->execute(order, params);
  vouch_.reset();
  answer_.reset();
  said_.reset();
  asked_ = {};
  armed_ = vouched_ = false;
  still_ = true;
  braked_ = order == can::Order::resume;
}

void GuardReplay::on_frame(const can::VelocityCommand& velocity) {
  armed_ = armed_ || (velocity.forward == 0 && velocity.turning == 0);
  if (armed_) said_ = velocity;
}

void GuardReplay::on_frame(const can::WheelCommand& command) {
  if (command.mode != can::DriveMode::drive) {
    braked_ = true;
    return;
  }
  answer_ = Answer{command, said_.value_or(asked_), said_.has_value(), vouched_ || (vouch_ && still_)};
  said_.reset();
}

bool GuardReplay::of_a_step(const can::GuardReport& told) {
  const bool waits =
      told.reason == static_cast<std::uint8_t>(GuardReason::command_timeout) && told.granted_forward == 0;
  return !waits;
}

GuardReplay::Step GuardReplay::step(const can::InputSet& set, const Answer& recorded,
                                    const can::GuardReport* told) {
  const Time now = can_app::time_of(set);
  if (recorded.heard) asked_at_ = now;
  asked_ = recorded.asked;
  bool vouched = recorded.vouched;
  if (told != nullptr) {
    armed_ = told->armed != 0;
    vouched = told->vouched != 0;
    guard_->guard().command(can_app::velocity_of({told->asked_forward, told->asked_turning}), now);
  } else {
    guard_->guard().command(can_app::velocity_of(asked_), asked_at_);
  }
  if (vouched && !vouched_ && vouch_) guard_->guard().vouch(millimetres(vouch_->radius_mm));
  vouched_ = vouched;
  const GuardStatus& status = guard_->step(set, braked_);
  braked_ = false;
  const hal::WheelSpeeds& speeds = recorded.command.speeds;
  still_ = still_ && speeds.left == 0 && speeds.right == 0;
  return {status.command, difference_of(recorded.command, "guard", status.command)};
}

}  // namespace whisker::hil
