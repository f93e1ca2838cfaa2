/// Messages about the pose: the gyro, a pose from outside, and how far the estimate may be off. The form is
/// that of messages.hpp.
#pragma once

#include <stdint.h>

#include "firmware/can/message_kind.hpp"
#include "firmware/can/signals.hpp"
#include "firmware/localization/pose_bound.hpp"

namespace whisker::can {

// clang-format off
// {name, start, length, signed, min, max, factor, unit, about, part, word}

struct PoseSigmaReport {
  static constexpr MessageKind kKind = MessageKind::pose_sigma;
  uint8_t source = 0;
  uint16_t along = 0;
  uint16_t across = 0;
  uint16_t heading = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Source", 12, 4, false, 0, 3, "1", "", "what turns the pose", kAlways, word_in<kHeadingWords>}, m.source);
    f({"Along", 16, 16, false, 0, 16000, "0.001", "m", "standard deviation of the position, along the heading"}, m.along);
    f({"Across", 32, 16, false, 0, 16000, "0.001", "m", "standard deviation of the position, across the heading"}, m.across);
    f({"Heading", 48, 16, false, 0, 16384, "0.0054931640625", "deg", "standard deviation of the heading"}, m.heading);
  }
};

/// The part of a hal::GyroReading that its receiver needs to continue the sums.
struct GyroState {
  static constexpr MessageKind kKind = MessageKind::gyro;
  uint8_t valid = 1;
  uint8_t tick = 0;
  hal::GyroReading reading{};

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Valid", 12, 1, false, 0, 1, "1", "", "0: the gyro does not answer"}, m.valid);
    f({"Tick", 13, 3, false, 0, 7, "1", "", "modulo 8"}, m.tick);
    f({"Sum", 16, 24, false, 0, kMost24, "1", "", "of all samples, modulo 2^24, counter-clockwise positive"}, m.reading.sum);
    f({"Samples", 40, 16, false, 0, kMost16, "1", "", "their number, modulo 2^16"}, m.reading.samples);
    f({"Saturated", 56, 8, false, 0, kMost8, "1", "", "how many of them were at the limit of the range, modulo 256"}, m.reading.saturated);
  }
};

constexpr int32_t kSigmaLimitUm = localization::PoseBound::kMost.raw();

/// All values lie at the same bits as the heading. The range of a value is checked where its part is known.
struct FixValue {
  static constexpr MessageKind kKind = MessageKind::fix;
  static constexpr Signal kMore[] = {
    {"X", 32, 32, true, INT32_MIN, INT32_MAX, "0.000001", "m", "measured pose of the body", 0},
    {"Y", 32, 32, true, INT32_MIN, INT32_MAX, "0.000001", "m", "", 1},
    {"SigmaAlong", 32, 32, false, 0, kSigmaLimitUm, "0.000001", "m", "standard deviation along the heading", 3},
    {"SigmaAcross", 32, 32, false, 0, kSigmaLimitUm, "0.000001", "m", "standard deviation across the heading", 4},
    {"SigmaHeading", 32, 32, false, 0, INT64_C(1) << 30, "8.381903171539306640625E-08", "deg", "standard deviation of the heading", 5},
  };
  FixPart part = FixPart::x;
  uint16_t tick = 0;
  uint32_t value = 0;  ///< raw, two's complement

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Part", 12, 4, false, 0, kFixValues - 1, "1", "", "one frame each", kMultiplexor, word_in<kFixPartWords>}, m.part);
    f({"Tick", 16, 16, false, 0, kMost16, "1", "", "modulo 2^16"}, m.tick);
    f({"Heading", 32, 32, false, 0, kMost32, "8.381903171539306640625E-08", "deg", "counter-clockwise from x", 2}, m.value);
  }
};

struct FixReply {
  static constexpr MessageKind kKind = MessageKind::fix_reply;
  FixStatus status = FixStatus::accepted;
  uint16_t tick = 0;
  uint16_t jumps = 0;
  uint16_t refused = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Status", 12, 4, false, 0, 2, "1", "", "result of the fix", kAlways, word_in<kFixStatusWords>}, m.status);
    f({"Tick", 16, 16, false, 0, kMost16, "1", "", "of the fix, modulo 2^16"}, m.tick);
    f({"Jumps", 32, 16, false, 0, kMost16, "1", "", "fixes of this mission that were jumps; saturates"}, m.jumps);
    f({"Refused", 48, 16, false, 0, kMost16, "1", "", "jumps that were refused; saturates"}, m.refused);
  }
};
// clang-format on

}  // namespace whisker::can
