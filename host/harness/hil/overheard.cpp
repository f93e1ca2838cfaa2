#include "host/harness/hil/overheard.hpp"

#include <utility>

#include "firmware/can/codec.hpp"
#include "firmware/can/headers.hpp"
#include "firmware/can/limits.hpp"

namespace whisker::hil {
namespace {

using can::MessageKind;

bool has_kind(const hal::CanFrame& frame, MessageKind& kind) {
  return !frame.extended && !frame.remote && can::kind_of(frame.id, kind);
}

bool is_whole(const hal::CanFrame& frame, MessageKind kind) {
  return frame.size == can::head_of(kind).size &&
         frame.data[0] == can::crc_of(frame.id, frame.data, frame.size);
}

}  // namespace

std::optional<Sender> sender_of(const hal::CanFrame& frame) {
  MessageKind kind = MessageKind::e_stop;
  if (!has_kind(frame, kind) || kind == MessageKind::e_stop) return {};
  const auto node = static_cast<std::uint8_t>(frame.id & 0x0F);
  const can::Party party = node >= can::kBaseOffset ? can::Party::base : can::Party::controller;
  const int robot = party == can::Party::base ? node - can::kBaseOffset : node;
  if (robot == 0 || !can::may_send(party, kind)) return {};
  return Sender{kind, party, robot, node, is_whole(frame, kind)};
}

std::optional<OperatorFrame> operator_frame(const hal::CanFrame& frame) {
  MessageKind kind = MessageKind::e_stop;
  if (!has_kind(frame, kind) || !can::is_operator(frame.id & 0x0F, kind)) return {};
  return OperatorFrame{kind, static_cast<int>(frame.id & 0x0F), is_whole(frame, kind)};
}

Status status_of(const can::NavStatus& told) {
  Status s;
  s.decision.outcome = told.outcome;
  s.decision.mode = told.state;
  s.decision.why = told.why;
  s.decision.danger_count = told.danger;
  s.decision.looked = told.looked != 0;
  s.health.fault = told.fault < kFaults ? static_cast<Fault>(told.fault) : Fault::none;
  return s;
}

Overheard::Overheard(const Params& params, Accepted accepted) : accepted_(std::move(accepted)) {
  server_.set(params);
}

void Overheard::restarted() {
  base_.accepted = operator_.accepted = -1;
  server_.drop(can::Requester::base);
}

void Overheard::on_frame(MessageKind kind, const hal::CanFrame& frame) {
  switch (kind) {
    case MessageKind::range_left: return on_range<MessageKind::range_left>(hal::kLeft, frame);
    case MessageKind::range_front: return on_range<MessageKind::range_front>(hal::kFront, frame);
    case MessageKind::range_right: return on_range<MessageKind::range_right>(hal::kRight, frame);
    case MessageKind::wheel_state: return with<can::WheelState>(frame, [&](const auto& m) { on_set(m); });
    case MessageKind::gyro: return with<can::GyroState>(frame, [&](const auto& m) { on_set(m); });
    case MessageKind::fix: return with<can::FixValue>(frame, [&](const auto& m) { on_set(m); });
    case MessageKind::sync: return with<can::Sync>(frame, [&](const auto& m) { on_set(m); });
    case MessageKind::mission_reply:
      return with<can::MissionReply>(frame, [&](const auto& m) { on_reply(m); });
    case MessageKind::param_reply: return with<can::ParamReply>(frame, [&](const auto& m) { on_reply(m); });
    default: return on_request(base_, kind, frame);
  }
}

void Overheard::on_operator(MessageKind kind, const hal::CanFrame& frame, std::uint64_t time_us) {
  // As the controller does.
  if (time_us - operator_us_ > std::uint64_t{can::kPeerLost_ms} * 1000) {
    operator_ = {};
    server_.drop(can::Requester::third_party);
  }
  operator_us_ = time_us;
  on_request(operator_, kind, frame);
}

void Overheard::on_request(Requests& from, MessageKind kind, const hal::CanFrame& frame) {
  if (kind == MessageKind::mission) on_mission(from, frame);
  if (kind == MessageKind::param_request) {
    with<can::ParamRequest>(frame, [&](const auto& m) { from.param = m; });
  }
}

const can::InputSet* Overheard::set_of(std::uint16_t tick16) const {
  const auto& set = sets_.kept[tick16 % kKept];
  return set && static_cast<std::uint16_t>(set->tick) == tick16 ? &*set : nullptr;
}

template <MessageKind kKind>
void Overheard::on_range(int beam, const hal::CanFrame& frame) {
  with<can::Range<kKind>>(frame, [&](auto m) {
    if (can::InputSets::sound(m.reading)) on_set(beam, m.reading, m.tick, m.bump);
  });
}

template <class... M>
void Overheard::Sets::on_frame(const M&... of_frame) {
  frames.on_frame(of_frame...);
  if (!frames.complete()) return;
  const can::InputSet set = frames.set();
  kept[set.tick % kKept] = set;
}

template <class... M>
void Overheard::on_set(const M&... of_frame) {
  sets_.on_frame(of_frame...);
  since_order_.on_frame(of_frame...);
}

void Overheard::on_mission(Requests& from, const hal::CanFrame& frame) {
  can::MissionValue part;
  if (!can::decode(frame, part)) return;
  if (part.part != can::MissionPart::order) return from.parts.on_frame(part);
  with<can::MissionOrder>(frame, [&](const auto& m) {
    const bool again = from.order && from.order->mission == m.mission;
    if (&from == &base_ && !again) since_order_ = {};
    from.order = m;
  });
}

void Overheard::on_reply(const can::MissionReply& reply) {
  Requests& to = of(reply.to_operator);
  if (reply.status != can::MissionStatus::accepted || !to.order || reply.mission != to.order->mission) return;
  can::Mission mission;
  const bool known = to.parts.complete(*to.order) && can::mission_of(to.parts.values(), mission);
  if (reply.mission == to.accepted || !known) return;
  to.accepted = reply.mission;
  const bool of_base = reply.to_operator == 0;
  accepted_(of_base ? can::Requester::base : can::Requester::third_party, to.order->order, mission);
  if (of_base) sets_ = since_order_;
}

void Overheard::on_reply(const can::ParamReply& reply) {
  const Requests& to = of(reply.to_operator);
  if (!to.param || reply.index != to.param->index) return;
  server_.answer(*to.param, reply.to_operator != 0 ? can::Requester::third_party : can::Requester::base,
                 reply.status == can::ParamStatus::busy);
}

}  // namespace whisker::hil
