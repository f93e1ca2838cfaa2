/// Headers: what a receiver needs of a message before it decodes the signals, without texts.
#pragma once

#include <stdint.h>

#include "firmware/can/ids.hpp"
#include "firmware/can/table.hpp"

namespace whisker::can {

struct Head {
  uint8_t size;
  bool from_controller;
  bool from_base;
};

struct Heads {
  static constexpr uint8_t kNone = 0xFF;
  static constexpr int kFunctions = 0x74;
  Head of[kKinds];
  uint8_t kind[kFunctions];  ///< by function; kNone: unused
};

constexpr Heads heads() noexcept {
  Heads h{};
  for (uint8_t& kind : h.kind) kind = Heads::kNone;
  for (uint8_t i = 0; i < kKinds; ++i) {
    const Message& m = kMessages[i];
    h.of[i] = {m.size, m.from_controller, m.from_base};
    h.kind[m.function] = i;
  }
  return h;
}

inline constexpr Heads kHeads = heads();

/// False: not a message of this protocol.
constexpr bool kind_of(uint32_t id, Kind& kind) noexcept {
  const uint32_t function = id >> 4;
  if (function >= Heads::kFunctions || kHeads.kind[function] == Heads::kNone) return false;
  kind = static_cast<Kind>(kHeads.kind[function]);
  return true;
}

constexpr const Head& head_of(Kind kind) noexcept { return kHeads.of[static_cast<uint8_t>(kind)]; }

constexpr bool may_send(Party party, Kind kind) noexcept {
  return party == Party::base ? head_of(kind).from_base : head_of(kind).from_controller;
}

}  // namespace whisker::can
