#include "host/bench/operator_link.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/can/codec.hpp"
#include "firmware/can/headers.hpp"
#include "firmware/can/limits.hpp"
#include "host/hil/overheard.hpp"

namespace whisker::bench {
namespace {

constexpr std::uint64_t kEvery_us =
    can::message_of(can::MessageKind::velocity).cycle_ms * std::uint64_t{1000};
/// After such a silence, the node sends its Info again, which may have been lost.
constexpr std::uint64_t kAskInfo_us = std::uint64_t{can::kPeerLost_ms} * 1000 + 100000;

std::int16_t units(double value, double per_unit) {
  return static_cast<std::int16_t>(std::clamp(std::floor(value / per_unit + 0.5), -32767.0, 32767.0));
}

}  // namespace

bool from_operator(const hal::CanFrame& frame, int robot) {
  const std::optional<hil::OperatorFrame> said = hil::operator_frame(frame);
  return said && said->robot == robot;
}

OperatorLink::OperatorLink(hal::CanPort& port, int robot, guard::Operator& hand, double vouched_m,
                           std::uint8_t vouch_number)
    : port_(port), robot_(robot), hand_(hand), vouched_m_(vouched_m), vouch_number_(vouch_number) {}

void OperatorLink::poll(std::uint64_t now_us) {
  const auto now_ms = static_cast<std::uint32_t>(now_us / 1000);
  port_.poll(now_ms);
  hal::CanFrame frame{};
  while (port_.receive(frame)) on_frame(frame);
  const std::uint64_t passed_us = now_us - sent_us_;
  if (trusted_ ? !due_ && passed_us < kEvery_us : passed_us < kAskInfo_us) return;
  due_ = false;
  sent_us_ = now_us;
  send_velocity();
  send_vouch();
  port_.poll(now_ms);
}

void OperatorLink::on_frame(const hal::CanFrame& frame) {
  disturbed_ = disturbed_ || from_operator(frame, robot_);
  can::MessageKind kind = can::MessageKind::e_stop;
  if (!seen_.on_frame(frame, robot_) || !can::kind_of(frame.id, kind)) return;
  if (kind != can::MessageKind::guard_status) return;
  due_ = true;
  if (steady()) ++driven_;
}

/// The node obeys, and nothing is left to say before the hand may ask.
bool OperatorLink::steady() const {
  if (!trusted_ || !seen_.guard || !seen_.sync) return false;
  return seen_.guard->armed != 0 && (vouched_m_ <= 0 || seen_.guard->vouched != 0 || started());
}

guard::Twist OperatorLink::wish() {
  if (ended_ || (!started() && !steady())) return {};
  const std::uint32_t tick = seen_.sync->tick;
  if (!first_tick_) {
    first_tick_ = tick;
    next_s_ = hand_.first_s();
  }
  time_s_ = (tick - *first_tick_) * (seen_.sync->period_ms * 1e-3);
  if (time_s_ >= next_s_) {
    twist_ = hand_.ask({{}, time_s_});
    asked_s_ = time_s_;
    next_s_ = time_s_ + hand_.pause_s();
  }
  return time_s_ - asked_s_ <= kHold_s ? twist_ : guard::Twist{};
}

void OperatorLink::send_velocity() {
  const guard::Twist twist = wish();
  const can::VelocityCommand command{units(twist.forward_mps, 1e-4), units(twist.turning_radps, 1e-3)};
  port_.send(can::encode(command, static_cast<std::uint8_t>(robot_), velocities_.next()), can::kLife_ms);
}

void OperatorLink::send_vouch() {
  if (vouched_m_ <= 0 || started() || !seen_.guard || seen_.guard->armed == 0) return;
  const auto radius_mm = static_cast<std::uint16_t>(std::lround(vouched_m_ * 1000));
  const can::VouchRequest vouch{vouch_number_, std::max<std::uint16_t>(radius_mm, 1)};
  port_.send(can::encode(vouch, static_cast<std::uint8_t>(robot_), vouches_.next()), can::kLife_ms);
}

bool OperatorLink::stands() const { return seen_.command && bench::stands(*seen_.command); }

}  // namespace whisker::bench
