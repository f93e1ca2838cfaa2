#include "host/bench/bus_run.hpp"

#include <utility>

#include "firmware/can/codec.hpp"
#include "firmware/can/headers.hpp"
#include "host/bench/survey.hpp"

namespace whisker::bench {
namespace {

using can::MessageKind;

/// After frames that were missed, the wheels may have rolled farther than in one period.
constexpr std::uint32_t kLongestPause_ms = 1000;

template <class M, class F>
void with(const hal::CanFrame& frame, const F& use) {
  M message;
  if (can::decode(frame, message)) use(message);
}

}  // namespace

BusRun::BusRun(int robot, const Params& params, Listener listener)
    : robot_(robot), params_(params), listener_(std::move(listener)) {
  server_.stage(params);
}

void BusRun::on_frame(const hal::CanFrame& frame) {
  MessageKind kind = MessageKind::e_stop;
  int owner = 0;
  can::Party party = can::Party::base;
  if (frame.extended || frame.remote || !can::kind_of(frame.id, kind)) return;
  if (!owner_of(static_cast<std::uint8_t>(frame.id & 0x0F), owner, party) || owner != robot_) return;
  if (!can::may_send(party, kind) || frame.size != can::head_of(kind).size) return;
  if (frame.data[0] == can::crc_of(frame.id, frame.data, frame.size)) execute(kind, frame);
}

void BusRun::execute(MessageKind kind, const hal::CanFrame& frame) {
  switch (kind) {
    case MessageKind::range_left: return on_range<MessageKind::range_left>(hal::kLeft, frame);
    case MessageKind::range_front: return on_range<MessageKind::range_front>(hal::kFront, frame);
    case MessageKind::range_right: return on_range<MessageKind::range_right>(hal::kRight, frame);
    case MessageKind::wheel_state:
      return with<can::WheelState>(frame, [&](const auto& m) { sets_.on_frame(m), keep(); });
    case MessageKind::gyro:
      return with<can::GyroState>(frame, [&](const auto& m) { sets_.on_frame(m), keep(); });
    case MessageKind::fix:
      return with<can::FixValue>(frame, [&](const auto& m) { sets_.on_frame(m), keep(); });
    case MessageKind::sync: return with<can::Sync>(frame, [&](const auto& m) { sets_.on_frame(m), keep(); });
    case MessageKind::mission: return on_mission(frame);
    case MessageKind::mission_reply:
      return with<can::MissionReply>(frame, [&](const auto& m) { on_reply(m); });
    case MessageKind::param_request:
      return with<can::ParamRequest>(frame, [&](const auto& m) { request_ = m; });
    case MessageKind::param_reply: return with<can::ParamReply>(frame, [&](const auto& m) { on_reply(m); });
    case MessageKind::wheel_command:
      return with<can::WheelCommand>(frame, [&](const auto& m) { command_ = m; });
    case MessageKind::nav_status: return with<can::NavStatus>(frame, [&](const auto& m) { on_status(m); });
    default: break;
  }
}

template <MessageKind kKind>
void BusRun::on_range(int beam, const hal::CanFrame& frame) {
  with<can::Range<kKind>>(frame, [&](auto m) {
    if (can::InputSets::sound(m.reading)) sets_.on_frame(beam, m.reading, m.tick, m.bump), keep();
  });
}

void BusRun::keep() {
  if (!sets_.complete()) return;
  const can::InputSet set = sets_.set();
  kept_[set.tick % kKept] = set;
}

void BusRun::on_mission(const hal::CanFrame& frame) {
  can::MissionValue part;
  if (!can::decode(frame, part)) return;
  if (part.part != can::MissionPart::order) return parts_.on_frame(part);
  with<can::MissionOrder>(frame, [&](const auto& m) { order_ = m; });
}

void BusRun::on_reply(const can::MissionReply& reply) {
  if (reply.status != can::MissionStatus::accepted || !order_ || reply.mission != order_->mission) return;
  can::Mission mission;
  const bool known = parts_.complete(*order_) && can::mission_of(parts_.values(), mission);
  if (reply.mission == accepted_ || !known) return;
  accepted_ = reply.mission;
  for (auto& set : kept_) set.reset();
  sets_.forget();
  tick16_.reset();
  if (order_->order == can::Order::start) begin(mission, true);
}

void BusRun::on_reply(const can::ParamReply& reply) {
  if (!request_ || reply.index != request_->index) return;
  bool committed = false;
  server_.answer(*request_, reply.status == can::ParamStatus::busy, committed);
  if (committed) params_ = server_.staged();
}

void BusRun::begin(const can::Mission& mission, bool heard) {
  begun_ = true;
  odometry_ = {};
  odometry_.configure(params_);
  odometry_.place(mission.start);
  if (listener_.begins) listener_.begins(mission, params_, heard);
}

void BusRun::on_status(const can::NavStatus& told) {
  if (tick16_ == told.tick || !command_ || command_->tick != told.tick) return;
  const std::optional<can::InputSet>& set = kept_[told.tick % kKept];
  if (!set || static_cast<std::uint16_t>(set->tick) != told.tick) return;
  if (!begun_) begin({}, false);
  const std::uint32_t passed = tick16_ ? (set->tick - tick_) * set->period_ms : kLongestPause_ms;
  localization::CountStep step;
  if (set->counts_valid) {
    odometry_.update(
        set->counts,
        Duration::from_raw(static_cast<std::int32_t>(passed < kLongestPause_ms ? passed : kLongestPause_ms)),
        step);
  }
  tick16_ = told.tick;
  tick_ = set->tick;
  Status status;
  status.decision.outcome = told.outcome;
  status.decision.mode = told.state;
  status.decision.why = told.why;
  status.decision.danger_count = told.danger;
  status.decision.looked = told.looked != 0;
  status.health.fault = told.fault < kFaults ? static_cast<Fault>(told.fault) : Fault::none;
  status.command = command_->speeds;
  status.pose = odometry_.pose();
  if (listener_.stepped) listener_.stepped(*set, status);
}

}  // namespace whisker::bench
