/// Messages between an operator, who is no node, and a guard node. The form is that of messages.hpp.
#pragma once

#include <stdint.h>

#include "firmware/can/message_kind.hpp"
#include "firmware/can/signals.hpp"

namespace whisker::can {

// clang-format off
// {name, start, length, signed, min, max, factor, unit, about, part, word}

struct VelocityCommand {
  static constexpr MessageKind kKind = MessageKind::velocity;
  int16_t forward = 0;
  int16_t turning = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Forward", 16, 16, true, -32767, 32767, "0.0001", "m/s", "of the body, negative: backwards"}, m.forward);
    f({"Turning", 32, 16, true, -32767, 32767, "0.001", "rad/s", "counter-clockwise positive"}, m.turning);
  }
};

struct VouchRequest {
  static constexpr MessageKind kKind = MessageKind::vouch;
  uint8_t number = 0;
  uint16_t radius_mm = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Number", 16, 8, false, 0, kMost8, "1", "", "a repetition has the same"}, m.number);
    f({"Radius", 24, 16, false, 1, 10000, "0.001", "m", "nothing stands within this distance of the body's centre"}, m.radius_mm);
  }
};

struct GuardReport {
  static constexpr MessageKind kKind = MessageKind::guard_status;
  uint8_t reason = 3;  ///< GuardReason::command_timeout
  int16_t asked_forward = 0;
  int16_t asked_turning = 0;
  uint8_t granted_forward = 0;
  uint8_t vouched = 0;
  uint8_t granted_turning = 0;
  uint8_t armed = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Reason", 12, 4, false, 0, 9, "1", "", "why the wheels do what they do", kAlways, word_in<kGuardReasonWords>}, m.reason);
    f({"AskedForward", 16, 16, true, -32767, 32767, "0.0001", "m/s", "of the last Velocity; 0 after its time-out"}, m.asked_forward);
    f({"AskedTurning", 32, 16, true, -32767, 32767, "0.001", "rad/s", ""}, m.asked_turning);
    f({"GrantedForward", 48, 7, false, 0, 100, "0.01", "", "share of the asked forward speed"}, m.granted_forward);
    f({"Vouched", 55, 1, false, 0, 1, "1", "", "1: a Vouch counts since the last order"}, m.vouched);
    f({"GrantedTurning", 56, 7, false, 0, 100, "0.01", "", "share of the asked turning"}, m.granted_turning);
    f({"Armed", 63, 1, false, 0, 1, "1", "", "1: a Velocity of zero has come since the last order"}, m.armed);
  }
};
// clang-format on

}  // namespace whisker::can
