/// Headers: the part of the table that a receiver needs before it decodes the signals, without texts.
#pragma once

#include <stdint.h>

#include "firmware/can/ids.hpp"
#include "firmware/can/table.hpp"

namespace whisker::can {

struct Head {
  uint8_t size;
  bool from_controller;
  bool from_base;
  bool from_operator;
  uint8_t operator_place;  ///< number of messages of the operator before this one
};

struct Headers {
  static constexpr uint8_t kNone = 0xFF;
  static constexpr int kFunctions = 0x74;
  Head of[kKinds];
  uint8_t kind[kFunctions];  ///< by function; kNone: unused
};

constexpr Headers headers() noexcept {
  Headers h{};
  for (uint8_t& kind : h.kind) kind = Headers::kNone;
  uint8_t of_operator = 0;
  for (uint8_t i = 0; i < kKinds; ++i) {
    const Message& m = kMessages[i];
    h.of[i] = {m.size, m.from_controller, m.from_base, m.from_operator, of_operator};
    if (m.from_operator) ++of_operator;
    h.kind[m.function] = i;
  }
  return h;
}

inline constexpr Headers kHeaders = headers();

/// False: not a message of this protocol.
constexpr bool kind_of(uint32_t id, MessageKind& kind) noexcept {
  const uint32_t function = id >> 4;
  if (function >= Headers::kFunctions || kHeaders.kind[function] == Headers::kNone) return false;
  kind = static_cast<MessageKind>(kHeaders.kind[function]);
  return true;
}

constexpr int count_operator_kinds() noexcept {
  int count = 0;
  for (const Message& m : kMessages) count += m.from_operator ? 1 : 0;
  return count;
}

constexpr int kOperatorKinds = count_operator_kinds();

constexpr const Head& head_of(MessageKind kind) noexcept { return kHeaders.of[static_cast<uint8_t>(kind)]; }

constexpr bool may_send(Party party, MessageKind kind) noexcept {
  return party == Party::base ? head_of(kind).from_base : head_of(kind).from_controller;
}

/// node: the sender of the identifier. The operator has the number of the controller.
constexpr bool is_operator(uint8_t node, MessageKind kind) noexcept {
  const Head& head = head_of(kind);
  return head.from_operator && (node < kBaseOffset || !head.from_base);
}

}  // namespace whisker::can
