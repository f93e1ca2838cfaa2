#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "firmware/can/codec.hpp"
#include "firmware/can/mission.hpp"
#include "host/harness/hil/candump.hpp"

namespace whisker::can {
namespace {

const Signal& signal(MessageKind kind, int i) { return message_of(kind).signals[i]; }

TEST(Codec, SharedPartsLieAtOnePlace) {
  for (int i = 4; i < 10; ++i) {
    EXPECT_EQ(signal(MessageKind::mission, i).start, signal(MessageKind::mission, 6).start);
    EXPECT_EQ(signal(MessageKind::mission, i).length, signal(MessageKind::mission, 6).length);
    EXPECT_EQ(signal(MessageKind::mission, i).part, i - 3);
  }
  for (int i = 1; i < 13; ++i) {
    EXPECT_EQ(signal(MessageKind::diagnostics, i).start,
              signal(MessageKind::diagnostics, 1 + (i - 1) % 3).start);
    EXPECT_EQ(signal(MessageKind::diagnostics, i).length, 16);
    EXPECT_EQ(signal(MessageKind::diagnostics, i).part, (i - 1) / 3);
  }
  for (int i = 2; i < 2 + kFixValues; ++i) {
    EXPECT_EQ(signal(MessageKind::fix, i).start, 32);
    EXPECT_EQ(signal(MessageKind::fix, i).length, 32);
  }
  EXPECT_EQ(signal(MessageKind::info, 2).start, signal(MessageKind::info, 3).start);
}

/// Decodes bit by bit, from the table alone.
std::int64_t slow_raw(const hal::CanFrame& f, const Signal& s) {
  std::int64_t raw = 0;
  for (int i = s.length - 1; i >= 0; --i) {
    const int bit = s.start + i;
    raw = raw * 2 + (f.data[bit / 8] >> (bit % 8) & 1);
  }
  return s.is_signed && raw >= INT64_C(1) << (s.length - 1) ? raw - (INT64_C(1) << s.length) : raw;
}

RC_GTEST_PROP(Codec, AWheelCommandComesBack, (std::int16_t left, std::int16_t right, std::uint16_t tick)) {
  RC_PRE(left != INT16_MIN && right != INT16_MIN);
  const WheelCommand in{DriveMode::drive, {left, right}, tick};
  const hal::CanFrame frame = encode(in, 3, 11);
  RC_ASSERT(frame.id == 0x103U && frame.size == 8 && !frame.extended && !frame.remote);
  RC_ASSERT(frame.data[0] == crc_of(frame.id, frame.data, frame.size) && counter_of(frame) == 11);
  RC_ASSERT(slow_raw(frame, signal(MessageKind::wheel_command, 1)) == left &&
            slow_raw(frame, signal(MessageKind::wheel_command, 2)) == right);
  RC_ASSERT(slow_raw(frame, signal(MessageKind::wheel_command, 3)) == tick &&
            slow_raw(frame, signal(MessageKind::wheel_command, 0)) == 1);
  WheelCommand out;
  RC_ASSERT(decode(frame, out));
  RC_ASSERT(out.speeds.left == left && out.speeds.right == right && out.tick == tick && out.mode == in.mode);
}

/// decode() must accept exactly the content that the table allows.
template <class M>
void agrees_with_the_table(const hal::CanFrame& frame) {
  const Message& message = message_of(M::kKind);
  bool in_range = true;
  for (int i = 0; i < message.count; ++i) {
    const std::int64_t raw = slow_raw(frame, message.signals[i]);
    in_range = in_range && raw >= message.signals[i].min && raw <= message.signals[i].max;
  }
  M m;
  RC_ASSERT(decode(frame, m) == in_range);
}

RC_GTEST_PROP(Codec, AnyContentIsJudgedByTheTable, (std::vector<std::uint8_t> bytes)) {
  hal::CanFrame frame{};
  frame.size = 8;
  for (std::size_t i = 0; i < 8 && i < bytes.size(); ++i) frame.data[i] = bytes[i];
  for_each_message([&](const Message&, auto message) {
    using M = decltype(message);
    // Not for messages with parts, whose signals are in several frames; reserved bits are ignored.
    constexpr bool kWhole = M::kKind != MessageKind::mission && M::kKind != MessageKind::info &&
                            M::kKind != MessageKind::info_request && M::kKind != MessageKind::diagnostics &&
                            M::kKind != MessageKind::fix;
    if constexpr (kWhole) agrees_with_the_table<M>(frame);
  });
}

RC_GTEST_PROP(Codec, OneFlippedByteNeverPassesTheCrc,
              (std::uint64_t bits, std::uint8_t at, std::uint8_t flip)) {
  RC_PRE(flip != 0);
  hal::CanFrame frame = sealed(bits, 0x119, 8, 3);
  frame.data[at % 8] ^= flip;
  RC_ASSERT(frame.data[0] != crc_of(frame.id, frame.data, frame.size));
}

TEST(Codec, AFrameOfAnotherIdentifierNeverPassesTheCrc) {
  for (std::uint32_t id = 0; id < 0x800; ++id) {
    hal::CanFrame frame = sealed(0x123456789A0000, id, 8, 0);
    for (int bit = 0; bit < 11; ++bit) {
      EXPECT_NE(frame.data[0], crc_of(id ^ 1U << bit, frame.data, 8));
    }
  }
}

RC_GTEST_PROP(Mission, ComesBackInParts,
              (std::int32_t x, std::int32_t y, std::uint32_t heading, std::int32_t gx)) {
  const auto place = [](std::int32_t um) { return Length::from_raw(um % (kPlaceLimitUm + 1)); };
  const Mission in{{{place(x), place(y)}, Angle::from_raw(heading)},
                   {{place(gx), Length::from_raw(7)}, Length::from_raw(100)}};
  MissionParts parts;
  const MissionValues values = values_of(in);
  const MissionOrder order{MissionPart::order, 9, Order::start, digest_of(values)};
  for (int i = 0; i < kMissionValues; ++i) {
    RC_ASSERT(!parts.complete(order));
    MissionValue part;
    RC_ASSERT(decode(encode(MissionValue{static_cast<MissionPart>(i + 1), 9, values.of[i]}, 9, 0), part));
    parts.on_frame(part);
  }
  RC_ASSERT(parts.complete(order));
  Mission out;
  RC_ASSERT(mission_of(parts.values(), out));
  RC_ASSERT(out.start.at.x == in.start.at.x && out.start.at.y == in.start.at.y);
  RC_ASSERT(out.start.heading.raw() == heading && out.goal.at.x == in.goal.at.x);
  MissionOrder other = order;
  other.digest ^= 1;
  RC_ASSERT(!parts.complete(other));
  other = order;
  other.mission = 8;
  RC_ASSERT(!parts.complete(other));
}

TEST(Mission, ValuesOutOfRangeAreRefused) {
  Mission m{{}, {{}, Length::from_raw(1)}};
  Mission out;
  EXPECT_TRUE(mission_of(values_of(m), out));
  m.goal.tolerance = Length::from_raw(0);
  EXPECT_FALSE(mission_of(values_of(m), out));
  m.goal.tolerance = Length::from_raw(1);
  m.start.at.x = Length::from_raw(INT32_MIN);
  EXPECT_FALSE(mission_of(values_of(m), out));
}

TEST(Codec, ARangeCarriesTheSwitchOnItsSideAndNothingWithoutABumper) {
  Range<MessageKind::range_left> in{{1234, hal::RangeStatus::ok, 20, 7}, 0xBEEF};
  const hal::CanFrame plain = encode(in, 9, 10);
  EXPECT_EQ(plain.data[5], 0x07) << "the bits were unused before";
  for (int state = 0; state < 4; ++state) {
    in.bump = static_cast<BumpState>(state);
    const hal::CanFrame frame = encode(in, 9, 10);
    EXPECT_EQ(frame.data[5], 0x07 | state << 4);
    Range<MessageKind::range_left> out;
    ASSERT_TRUE(decode(frame, out));
    EXPECT_EQ(out.bump, in.bump);
  }
}

/// Frames that other tools decode: tests/can/golden_frames.txt has their bytes and physical values.
std::vector<hal::CanFrame> golden_frames() {
  WheelState wheels{1, 5, {0x123456, 0xFFFFFE}};
  Range<MessageKind::range_left> left{{1234, hal::RangeStatus::ok, 20, 7}, 0xBEEF};
  Range<MessageKind::range_front> front{{65535, hal::RangeStatus::clear, 0, 15}, 0};
  Range<MessageKind::range_right> right{{65534, hal::RangeStatus::stale, 255, 0}, 1};
  Heartbeat beat;
  beat.state = NodeState::safe_stop;
  beat.errors = Error::command_late | Error::bus_off;
  beat.boot = 0xABCD;
  beat.uptime_s = 200;
  return {
      encode(EStop{}, 0, 0),
      encode(EStop{kClearCommand}, 0, 0),
      encode(EStop{kClearCommand}, 1, 1),
      encode(Sync{SyncMode::lockstep, 123456789, 10, 42}, 9, 2),
      encode(Sync{SyncMode::real_time, 123456789, 10, 42, 1, 1}, 9, 3),
      encode(FaultReport{Severity::latched, Error::e_stop, 3, 4}, 1, 3),
      encode(MissionOrder{MissionPart::order, 2, Order::resume, 0xCAFE}, 9, 4),
      encode(MissionValue{MissionPart::start_heading, 2, 0x40000000}, 9, 5),
      encode(MissionValue{MissionPart::goal_x, 2, static_cast<std::uint32_t>(-4000000)}, 9, 6),
      encode(MissionOrder{MissionPart::order, 3, Order::cancel, 0xBEEF}, 1, 7),
      encode(MissionValue{MissionPart::goal_tolerance, 3, 250000}, 1, 8),
      encode(MissionReply{MissionStatus::incomplete, 2}, 1, 7),
      encode(MissionReply{MissionStatus::unsupported, 3, 1}, 1, 8),
      encode(VelocityCommand{2500, -1234}, 1, 5),
      encode(VouchRequest{7, 350}, 1, 6),
      encode(WheelCommand{DriveMode::drive, {3000, -2999}, 0x1234}, 1, 8),
      encode(wheels, 9, 9),
      encode(left, 9, 10),
      encode(front, 9, 11),
      encode(right, 9, 12),
      encode(NavStatus{planning::Outcome::reached, planning::Mode::arrived, 1, planning::Why::at_goal, 3, 0,
                       999},
             1, 13),
      encode(ParamRequest{ParamAction::write, 4, 0xFFFFFFFF}, 9, 14),
      encode(ParamRequest{ParamAction::commit, 255, 0}, 1, 3),
      encode(ParamReply{ParamStatus::out_of_range, 4, 50000}, 1, 0),
      encode(ParamReply{ParamStatus::inconsistent, 255, 17, 1}, 1, 1),
      encode(RangeTrustReport{RangeLevel::doubtful, 896, 64, 128, 47}, 1, 5),
      encode(PoseSigmaReport{2, 87, 1234, 546}, 1, 6),
      encode(GyroState{1, 5, {0xFF123456, 0xFEDC, 0x0102}}, 9, 7),
      encode(FixValue{FixPart::y, 0xBEEF, static_cast<std::uint32_t>(-1500000)}, 9, 8),
      encode(FixValue{FixPart::heading, 0xBEEF, 0xC0000000}, 9, 9),
      encode(FixValue{FixPart::sigma_across, 0xBEEF, 30000}, 9, 10),
      encode(FixReply{FixStatus::refused, 0xBEEF, 3, 2}, 1, 11),
      encode(GuardReport{5, 2500, -1234, 40, 1, 99, 1}, 1, 12),
      encode(RulesPart{5, 1880, {-24576, 32767}}, 9, 12),
      encode(RulesOrder{5, RulesAction::restore, 0x18749DCC}, 9, 13),
      encode(RulesReply{RulesStatus::wrong_hash, 5, 1, 1881}, 1, 14),
      encode(CalibrationReport{calibration::Quantity::track, planning::Trouble::scene_moved,
                               storage::Stored::not_written, 200, 140959, 448},
             1, 15),
      encode(beat, 9, 1),
      encode(Info{InfoPart::table_hash, 0xABCD, 0x12345678}, 1, 2),
      encode(Info{InfoPart::version, 0xABCD, 0x010203}, 9, 3),
      encode(Info{InfoPart::rules_hash, 0xABCD, 0xB02921C5}, 1, 4),
      encode(Diagnostics{2, {1, 65535, 3}}, 9, 4),
  };
}

TEST(Codec, GoldenFramesAreTheCommittedOnes) {
  std::ifstream file(std::string(WHISKER_SOURCE_DIR) + "/tests/can/golden_frames.txt");
  ASSERT_TRUE(file);
  std::string line;
  for (const hal::CanFrame& frame : golden_frames()) {
    ASSERT_TRUE(std::getline(file, line));
    const std::string text = hil::log_line({0, "can0", frame});
    EXPECT_EQ(line.substr(0, line.find(' ')), text.substr(text.rfind(' ') + 1)) << line;
  }
  EXPECT_FALSE(std::getline(file, line)) << line;
}

}  // namespace
}  // namespace whisker::can
