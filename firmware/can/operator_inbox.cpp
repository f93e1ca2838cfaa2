#include "firmware/can/operator_inbox.hpp"

namespace whisker::can {

void OperatorInbox::disarm() noexcept { armed_ = commanded_ = asked_ = numbered_ = false; }

void OperatorInbox::on_frame(const VelocityCommand& velocity, uint32_t now_ms) noexcept {
  armed_ = armed_ || (velocity.forward == 0 && velocity.turning == 0);
  velocity_ = velocity;
  velocity_at_ = now_ms;
  commanded_ = armed_;
}

void OperatorInbox::on_frame(const VouchRequest& vouch) noexcept {
  if (numbered_ && vouch.number == vouch_.number) return;
  numbered_ = asked_ = true;
  vouch_ = vouch;
}

bool OperatorInbox::take(VelocityCommand& velocity, uint32_t now_ms, uint32_t& age_ms) noexcept {
  if (!commanded_) return false;
  commanded_ = false;
  velocity = velocity_;
  age_ms = now_ms - velocity_at_;
  return true;
}

bool OperatorInbox::take(VouchRequest& vouch) noexcept {
  if (!asked_) return false;
  asked_ = false;
  vouch = vouch_;
  return true;
}

}  // namespace whisker::can
