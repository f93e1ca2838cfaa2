#include "firmware/can/rules_sender.hpp"

#include "firmware/fuzzy/digest.hpp"

namespace whisker::can {

using fuzzy::kTableNodes;

RulesSender::RulesSender(BaseNode& node, const Table* table, uint8_t upload) noexcept
    : node_(node), table_(table) {
  order_.upload = static_cast<uint8_t>(upload & 0x0F);
  order_.action = table != nullptr ? RulesAction::activate : RulesAction::restore;
  order_.hash = table != nullptr ? fuzzy::digest(*table) : 0;
}

void RulesSender::poll(uint32_t now) noexcept {
  RulesReply reply;
  while (!ended_ && node_.take(reply)) {
    if (reply.upload == order_.upload) on_reply(reply);
  }
  if (ended_ || !node_.matched()) return;
  if (sent_ && now - sent_at_ < kRulesRepeat_ms) return;
  if (sent_) next_ = had_;
  sent_ = ordering_ ? node_.request(order_) : send_parts();
  sent_at_ = now;
}

void RulesSender::on_reply(const RulesReply& reply) noexcept {
  reply_ = reply;
  switch (reply.status) {
    case RulesStatus::incomplete:
    case RulesStatus::receiving:
      // A block that was sent twice is answered twice. The second answer must not repeat the next block, too.
      if (!ordering_ && sent_ && reply.next == had_) break;
      had_ = next_ = reply.next;
      ordering_ = had_ == kTableNodes;
      sent_ = false;
      break;
    case RulesStatus::activated:
    case RulesStatus::wrong_hash:
    case RulesStatus::running:
    case RulesStatus::moving:
    case RulesStatus::unsupported: ended_ = true; break;
  }
}

bool RulesSender::send_parts() noexcept {
  const auto block = static_cast<uint16_t>(had_ - had_ % kRulesBlock + kRulesBlock);
  const uint16_t end = block < kTableNodes ? block : kTableNodes;
  for (; next_ < end; ++next_) {
    if (!node_.request(RulesPart{order_.upload, next_, fuzzy::node_of(*table_, next_)})) return false;
  }
  return true;
}

}  // namespace whisker::can
