#include "firmware/can/rules_server.hpp"

namespace whisker::can {

using fuzzy::kTableNodes;
using fuzzy::Stored;

Stored RulesServer::load() noexcept {
  if (store_ == nullptr) return Stored::nothing;
  Table& into = room();
  bool has_table = false;
  const Stored found = store_->load(into, has_table);
  if (found == Stored::ok && has_table) activate(into);
  kept_ = found == Stored::ok;
  return found;
}

void RulesServer::activate(const Table& table) noexcept {
  active_ = &table;
  hash_ = fuzzy::digest(table);
  begun_ = false;
  kept_ = false;
  tried_ = false;
}

void RulesServer::keep(uint8_t upload) noexcept {
  if (store_ == nullptr || kept_ || (tried_ && upload == tried_for_)) return;
  tried_ = true;
  tried_for_ = upload;
  kept_ = store_->save(active_ == &built_in_ ? nullptr : active_) == Stored::ok;
}

RulesReply RulesServer::reply(RulesStatus status, uint8_t upload) const noexcept {
  RulesReply reply;
  reply.status = status;
  reply.upload = upload;
  reply.kept = kept_ ? 1 : 0;
  reply.next = begun_ && upload == upload_ ? next_ : 0;
  return reply;
}

RulesReply RulesServer::take(const RulesPart& part) noexcept {
  if (!begun_ || part.upload != upload_) {
    upload_ = part.upload;
    next_ = 0;
    begun_ = true;
  }
  if (part.node == next_) {
    Table& into = room();
    if (&into == active_) {
      activate(built_in_);
      begun_ = true;
    }
    fuzzy::node_of(into, next_) = part.answer;
    ++next_;
  }
  return reply(RulesStatus::receiving, part.upload);
}

RulesReply RulesServer::execute(const RulesOrder& order) noexcept {
  const bool restores = order.action == RulesAction::restore || order.hash == built_in_hash_;
  if (restores) {
    if (active_ != &built_in_) activate(built_in_);
  } else if (order.hash != hash_) {
    const bool complete = begun_ && order.upload == upload_ && next_ == kTableNodes;
    if (!complete) return reply(RulesStatus::incomplete, order.upload);
    if (fuzzy::digest(room()) != order.hash) {
      begun_ = false;
      return reply(RulesStatus::wrong_hash, order.upload);
    }
    activate(room());
  }
  keep(order.upload);
  return reply(RulesStatus::activated, order.upload);
}

}  // namespace whisker::can
