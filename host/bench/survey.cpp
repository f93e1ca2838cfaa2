#include "host/bench/survey.hpp"

#include "firmware/can/codec.hpp"
#include "firmware/can/headers.hpp"
#include "firmware/can/limits.hpp"

namespace whisker::bench {

bool owner_of(std::uint8_t node, int& robot, can::Party& party) {
  party = node > can::kBaseOffset ? can::Party::base : can::Party::controller;
  robot = party == can::Party::base ? node - can::kBaseOffset : node;
  return robot >= 1 && robot <= can::kRobots;
}

void Survey::on_frame(const hal::CanFrame& frame, std::uint64_t now_us) {
  can::MessageKind kind = can::MessageKind::e_stop;
  if (frame.extended || frame.remote || !can::kind_of(frame.id, kind)) return;
  int robot = 0;
  can::Party party = can::Party::base;
  const auto number = static_cast<std::uint8_t>(frame.id & 0x0F);
  if (!owner_of(number, robot, party) || !can::may_send(party, kind)) return;
  if (frame.size != can::head_of(kind).size) return;
  if (frame.data[0] != can::crc_of(frame.id, frame.data, frame.size)) return;
  can::Heartbeat beat;
  can::Info info;
  if (kind == can::MessageKind::heartbeat && can::decode(frame, beat)) {
    SeenNode& node = nodes_[number];
    if (node.robot == 0 || node.beat.boot != beat.boot) node = {};
    node.robot = static_cast<std::uint8_t>(robot);
    node.party = party;
    node.beat = beat;
    node.heard_us = now_us;
  } else if (kind == can::MessageKind::info && can::decode(frame, info)) {
    const auto node = nodes_.find(number);
    if (node == nodes_.end() || node->second.beat.boot != info.boot) return;
    switch (info.part) {
      case can::InfoPart::table_hash: node->second.table_hash = info.value; break;
      case can::InfoPart::version: node->second.version = info.value; break;
      case can::InfoPart::rules_hash: node->second.rules = info.value; break;
    }
  }
}

const SeenNode* Survey::find(int robot, can::Party party) const {
  const auto node = nodes_.find(can::node_of(static_cast<std::uint8_t>(robot), party));
  return node == nodes_.end() ? nullptr : &node->second;
}

bool Survey::alive(int robot, can::Party party, std::uint64_t now_us) const {
  const SeenNode* const node = find(robot, party);
  return node != nullptr && now_us - node->heard_us <= std::uint64_t{can::kPeerLost_ms} * 1000;
}

bool SurveyPort::receive(hal::CanFrame& out) noexcept {
  if (!port_.receive(out)) return false;
  survey_.on_frame(out, clock_.now_us());
  return true;
}

}  // namespace whisker::bench
