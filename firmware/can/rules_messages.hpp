/// Messages that carry a response table to the controller. The form is that of messages.hpp.
#pragma once

#include <stdint.h>

#include "firmware/can/message_kind.hpp"
#include "firmware/can/signals.hpp"
#include "firmware/fuzzy/table_store.hpp"

namespace whisker::can {

/// RulesReply follows the last part of each block of so many.
constexpr uint16_t kRulesBlock = 8;

// clang-format off
// {name, start, length, signed, min, max, factor, unit, about, part, word}
inline constexpr Signal kUploadNumber = {"Upload", 12, 4, false, 0, kMost4, "1", "", "number, a new one for every table"};

struct RulesPart {
  static constexpr MessageKind kKind = MessageKind::rules_part;
  uint8_t upload = 0;
  uint16_t node = 0;
  fuzzy::Bilinear::Node answer{0, 0};

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f(kUploadNumber, m.upload);
    f({"Node", 16, 16, false, 0, fuzzy::kTableNodes - 1, "1", "", "R within D: 57 nodes in R for each of 33 in D"}, m.node);
    f({"Turn", 32, 16, true, INT16_MIN, INT16_MAX, "6.103515625E-05", "", "SA at this node"}, m.answer.turn);
    f({"Step", 48, 16, true, INT16_MIN, INT16_MAX, "6.103515625E-05", "", "SD at this node"}, m.answer.step);
  }
};

struct RulesOrder {
  static constexpr MessageKind kKind = MessageKind::rules_order;
  uint8_t upload = 0;
  RulesAction action = RulesAction::activate;
  uint32_t hash = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f(kUploadNumber, m.upload);
    f({"Action", 16, 8, false, 0, 1, "1", "", "executed only while the robot stands", kAlways, word_in<kRulesActionWords>}, m.action);
    f({"RulesHash", 24, 32, false, 0, kMost32, "1", "", "of the table to activate, as in Info"}, m.hash);
  }
};

struct RulesReply {
  static constexpr MessageKind kKind = MessageKind::rules_reply;
  RulesStatus status = RulesStatus::receiving;
  uint8_t upload = 0;
  uint8_t kept = 0;
  uint16_t next = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Status", 12, 4, false, 0, kRulesStatuses - 1, "1", "", "result of the order or of the parts", kAlways, word_in<kRulesStatusWords>}, m.status);
    f({"Upload", 16, 4, false, 0, kMost4, "1", "", "of the order or the part"}, m.upload);
    f({"Kept", 20, 1, false, 0, 1, "1", "", "1: the controller's storage has the active table"}, m.kept);
    f({"Next", 24, 16, false, 0, fuzzy::kTableNodes, "1", "", "first node that is missing; 1881: none"}, m.next);
  }
};
// clang-format on

constexpr bool ends_block(const RulesPart& part) noexcept {
  return part.node % kRulesBlock == kRulesBlock - 1 || part.node == fuzzy::kTableNodes - 1;
}

}  // namespace whisker::can
