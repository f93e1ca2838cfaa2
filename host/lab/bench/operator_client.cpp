#include "host/lab/bench/operator_client.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "firmware/can/codec.hpp"
#include "firmware/can/headers.hpp"
#include "firmware/can/limits.hpp"
#include "firmware/can/table_hash.hpp"
#include "host/harness/hil/error_names.hpp"
#include "host/harness/hil/overheard.hpp"

namespace whisker::bench {
namespace {

constexpr std::uint64_t kEvery_us =
    can::message_of(can::MessageKind::velocity).cycle_ms * std::uint64_t{1000};
/// After such a silence, the node sends its Info again, which may have been lost.
constexpr std::uint64_t kAskInfo_us = std::uint64_t{can::kPeerLost_ms} * 1000 + 100000;

std::int16_t units(double value, double per_unit) {
  return static_cast<std::int16_t>(std::clamp(std::floor(value / per_unit + 0.5), -32767.0, 32767.0));
}

constexpr std::uint64_t kSettles_us = 100000;
constexpr std::uint64_t kOrderAgain_us = std::uint64_t{can::kOrderRepeat_ms} * 1000;

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

OperatorClient::OperatorClient(hal::CanPort& port, hil::Clock& clock, const Survey& survey, int robot,
                               std::uint8_t number, Patience patience)
    : ParamClient(clock, std::move(patience)), port_(port), survey_(survey), robot_(robot), number_(number) {}

template <class M>
void OperatorClient::send(const M& message, can::AliveSender& alive) {
  port_.send(can::encode(message, static_cast<std::uint8_t>(robot_), alive.next()), can::kEventLife_ms);
}

void OperatorClient::poll() {
  const std::uint32_t now_ms = clock().now_ms();
  port_.poll(now_ms);
  hal::CanFrame frame{};
  while (port_.receive(frame)) on_frame(frame);
}

void OperatorClient::on_frame(const hal::CanFrame& frame) {
  if (from_operator(frame, robot_)) {
    throw NoAnswer(fmt::format("another operator commands robot {}", robot_));
  }
  can::MessageKind kind = can::MessageKind::e_stop;
  if (!seen_.on_frame(frame, robot_) || !can::kind_of(frame.id, kind)) return;
  if (kind == can::MessageKind::nav_status) hil::with<can::NavStatus>(frame, [&](auto& m) { on_status(m); });
  if (kind == can::MessageKind::param_reply) {
    hil::with<can::ParamReply>(frame, [&](const auto& m) {
      if (m.to_operator != 0) reply_ = m;
    });
  }
  if (kind != can::MessageKind::mission_reply) return;
  hil::with<can::MissionReply>(frame, [&](const auto& m) {
    if (m.to_operator == 0) {
      replaced_ = replaced_ || m.status == can::MissionStatus::accepted;
    } else if (m.mission == number_) {
      answer_ = m.status;
    }
  });
}

/// In lockstep, the status before the answer to the order may be repeated after it.
void OperatorClient::on_status(const can::NavStatus& status) {
  heard_us_ = clock().now_us();
  if (!answer_) tick_before_ = status.tick;
  const bool drives = drives_ && answer_ == can::MissionStatus::accepted;
  if (!drives || replaced_ || ended_ || status.tick == tick_before_) return;
  if (status.outcome != planning::Outcome::running || status.fault != 0) ended_ = status;
}

void OperatorClient::request(const can::ParamRequest& request) {
  reply_.reset();
  send(request, requests_);
  port_.poll(clock().now_ms());
}

bool OperatorClient::replied(can::ParamReply& reply) const {
  if (reply_) reply = *reply_;
  return reply_.has_value();
}

void OperatorClient::connect() {
  // The Info answers the first frame after a silence.
  constexpr std::uint64_t kAgain_us = std::uint64_t{can::kPeerLost_ms} * 1000 + 100000;
  std::optional<std::uint64_t> asked_us;
  const auto informed = [&] {
    if (controller() != nullptr && controller()->table_hash && controller()->version) return true;
    if (!asked_us || clock().now_us() - *asked_us >= kAgain_us) {
      request({can::ParamAction::read, 0, 0});
      asked_us = clock().now_us();
    }
    return false;
  };
  wait_until(informed, "Info with its table");
  if (*controller()->table_hash != can::kTableHash) {
    throw NoAnswer("the controller speaks another protocol or table (wrong_version)");
  }
}

void OperatorClient::send_order(can::Order order, const can::MissionValues& values) {
  for (int i = 0; i < can::kMissionValues; ++i) {
    send(can::MissionValue{static_cast<can::MissionPart>(i + 1), number_, values.of[i]}, missions_);
  }
  send(can::MissionOrder{can::MissionPart::order, number_, order, can::digest_of(values)}, missions_);
  port_.poll(clock().now_ms());
}

can::MissionStatus OperatorClient::order(can::Order order, const planning::Goal& goal) {
  const can::MissionValues values = can::values_of({{}, goal});
  ++number_;
  answer_.reset();
  std::optional<std::uint64_t> sent_us;
  const auto answered = [&] {
    if (answer_ && *answer_ != can::MissionStatus::incomplete) return true;
    if (!sent_us || clock().now_us() - *sent_us >= kOrderAgain_us) {
      send_order(order, values);
      sent_us = clock().now_us();
    }
    return false;
  };
  wait_until(answered, "MissionReply");
  return *answer_;
}

void OperatorClient::refuse(const char* what, can::MissionStatus status) const {
  if (status == can::MissionStatus::unsupported) {
    throw NoAnswer(
        fmt::format("the controller takes no {} (unsupported): it is a guard node, or calibrates", what));
  }
  throw NoAnswer(
      fmt::format("the controller says {} to the {} ({}): its base must give an order to start first",
                  can::kMissionStatusWords[static_cast<int>(status)], what, state()));
}

std::string OperatorClient::state() const {
  const can::Heartbeat& beat = controller()->beat;
  const std::string word = can::kNodeStateWords[static_cast<int>(beat.state)];
  return beat.errors == 0 ? word : word + ": " + hil::error_names(beat.errors);
}

void OperatorClient::cancel() {
  const can::MissionStatus status = order(can::Order::cancel, {{}, millimetres(1)});
  if (status != can::MissionStatus::accepted) refuse("cancel", status);
  const auto stand = [&] { return seen_.command && stands(*seen_.command); };
  wait_until(stand, "WheelCommand to stand");
}

void OperatorClient::drive_to(const planning::Goal& goal) {
  replaced_ = false;
  drives_ = true;
  ended_.reset();
  const auto stopped = [&] { return controller()->beat.state != can::NodeState::running; };
  wait_until([&] { return seen_.status || stopped(); }, "NavStatus");
  can::MissionStatus status = can::MissionStatus::refused;
  std::optional<std::uint64_t> ordered_us;
  // While it brakes, it is not idle.
  const auto settled = [&] {
    if (ordered_us && clock().now_us() - *ordered_us < kSettles_us) return false;
    const bool goes = seen_.status && seen_.status->outcome == planning::Outcome::running;
    status = order(goes ? can::Order::resume : can::Order::start, goal);
    ordered_us = clock().now_us();
    return status != can::MissionStatus::refused || stopped();
  };
  wait_until(settled, "MissionReply that accepts");
  if (status != can::MissionStatus::accepted) refuse("goal", status);
  first_tick_.reset();
  begin_time();
  heard_us_ = clock().now_us();
}

std::optional<can::NavStatus> OperatorClient::ended() {
  poll();
  begin_time();
  if (ended_) return ended_;
  if (replaced_) throw NoAnswer("the base has given another order");
  if (clock().now_us() - heard_us_ > std::uint64_t{patience_ms()} * 1000) {
    throw NoAnswer(fmt::format("the controller sends no NavStatus for {} ms ({})", patience_ms(), state()));
  }
  return std::nullopt;
}

/// The goal may be accepted before the first Sync is heard.
void OperatorClient::begin_time() {
  if (!first_tick_ && seen_.sync) first_tick_ = seen_.sync->tick;
}

double OperatorClient::time_s() const {
  if (!first_tick_) return 0;
  return (seen_.sync->tick - *first_tick_) * (seen_.sync->period_ms * 1e-3);
}

}  // namespace whisker::bench
