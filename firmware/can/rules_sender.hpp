#pragma once

#include <stdint.h>

#include "firmware/can/base_node.hpp"

namespace whisker::can {

/// Sends a response table to the controller and activates it; the base's side of RulesServer.
///
///   RulesSender sender{node, table};
///   every millisecond:  node.poll(now);  sender.poll(now);  until sender.ended()
class RulesSender {
 public:
  using Table = fuzzy::Bilinear::Table;

  /// Both must outlive it. table: null to restore the controller's built-in table. upload: a number other
  /// than that of the sender before.
  RulesSender(BaseNode& node, const Table* table, uint8_t upload) noexcept;

  /// Repeats what is not answered, without limit. While the handshake is missing, it waits.
  void poll(uint32_t now_ms) noexcept;
  /// The controller has activated the table, or refuses it: see reply().
  bool ended() const noexcept { return ended_; }
  /// The last reply of the controller. Once ended: activated, or running, moving, unsupported or wrong_hash:
  /// then the table is not active.
  const RulesReply& reply() const noexcept { return reply_; }
  /// Of the table; 0: restores.
  uint32_t hash() const noexcept { return order_.hash; }

 private:
  void on_reply(const RulesReply& reply) noexcept;
  bool send_parts() noexcept;

  BaseNode& node_;
  const Table* const table_;
  RulesOrder order_;
  RulesReply reply_;
  uint16_t next_ = 0;  // node to send
  uint16_t had_ = 0;   // nodes that the controller has
  bool ordering_ = true;
  bool sent_ = false;  // the order, or the block
  uint32_t sent_at_ = 0;
  bool ended_ = false;
};

}  // namespace whisker::can
