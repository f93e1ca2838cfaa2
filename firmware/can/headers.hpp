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
  for (uint8_t i = 0; i < kKinds; ++i) {
    const Message& m = kMessages[i];
    h.of[i] = {m.size, m.from_controller, m.from_base, m.from_operator};
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

constexpr const Head& head_of(MessageKind kind) noexcept { return kHeaders.of[static_cast<uint8_t>(kind)]; }

constexpr bool may_send(Party party, MessageKind kind) noexcept {
  return party == Party::base ? head_of(kind).from_base : head_of(kind).from_controller;
}

}  // namespace whisker::can
