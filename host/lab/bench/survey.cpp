#include "host/lab/bench/survey.hpp"

#include "firmware/can/codec.hpp"
#include "firmware/can/limits.hpp"
#include "host/harness/hil/overheard.hpp"

namespace whisker::bench {

void Survey::on_frame(const hal::CanFrame& frame, std::uint64_t now_us) {
  const std::optional<hil::Sender> sender = hil::sender_of(frame);
  if (!sender || !sender->whole) return;
  can::Heartbeat beat;
  can::Info info;
  if (sender->kind == can::MessageKind::guard_status) {
    const auto node = nodes_.find(sender->node);
    if (node != nodes_.end()) node->second.guards = true;
  } else if (sender->kind == can::MessageKind::heartbeat && can::decode(frame, beat)) {
    SeenNode& node = nodes_[sender->node];
    if (node.robot == 0 || node.beat.boot != beat.boot) node = {};
    node.robot = static_cast<std::uint8_t>(sender->robot);
    node.party = sender->party;
    node.beat = beat;
    node.drove = node.drove || beat.state == can::NodeState::running;
    node.heard_us = now_us;
  } else if (sender->kind == can::MessageKind::info && can::decode(frame, info)) {
    const auto node = nodes_.find(sender->node);
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
  return node != nullptr && now_us <= node->heard_us + std::uint64_t{can::kPeerLost_ms} * 1000;
}

bool Survey::misses_one(int robot) const {
  const SeenNode* const controller = find(robot, can::Party::controller);
  const SeenNode* const base = find(robot, can::Party::base);
  const SeenNode* const only = controller == nullptr ? base : base == nullptr ? controller : nullptr;
  return only != nullptr && (only->matches() || only->drove);
}

bool SurveyPort::receive(hal::CanFrame& out) noexcept {
  if (!port_.receive(out)) return false;
  survey_.on_frame(out, clock_.now_us());
  return true;
}

}  // namespace whisker::bench
