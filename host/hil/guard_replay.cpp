#include "host/hil/guard_replay.hpp"

#include <fmt/format.h>

namespace whisker::hil {

void GuardReplay::execute(can::Order order, const Params& params) {
  guard_->execute(order, params);
  vouched_ = false;
  vouch_.reset();
  answer_.reset();
  braked_ = order == can::Order::resume;
}

void GuardReplay::on_frame(const can::WheelCommand& command) {
  if (command.mode == can::DriveMode::drive) {
    answer_ = command;
  } else {
    braked_ = true;
  }
}

GuardReplay::Step GuardReplay::step(const can::InputSet& set, const can::WheelCommand& recorded,
                                    const can::GuardReport& told) {
  if (told.vouched != 0 && !vouched_ && vouch_) guard_->guard().vouch(millimetres(vouch_->radius_mm));
  vouched_ = told.vouched != 0;
  guard_->guard().command(can_app::velocity_of({told.asked_forward, told.asked_turning}),
                          can_app::time_of(set));
  const GuardStatus& status = guard_->step(set, braked_);
  braked_ = false;
  Step out{status.command, ""};
  if (status.command.left != recorded.speeds.left || status.command.right != recorded.speeds.right) {
    out.difference =
        fmt::format("tick {}: recorded {} {}, the guard says {} {} (0.1 mm/s)", recorded.tick,
                    recorded.speeds.left, recorded.speeds.right, status.command.left, status.command.right);
  }
  return out;
}

}  // namespace whisker::hil
