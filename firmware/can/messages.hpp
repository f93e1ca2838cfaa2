/// The table of the protocol: every message, its signals, and the field of each signal. The codec uses it at
/// compile time; whisker.dbc and docs/protocol.md are generated from it. docs/development.md shows how to add
/// a message.
///
/// All signals are little-endian: bit n is bit n % 8 of byte n / 8, and a signal starts with its lowest bit.
/// Every message also has Crc (bits 0 to 7) and Counter (bits 8 to 11), see e2e.hpp.
#pragma once

#include <stdint.h>

#include "firmware/can/calibration_messages.hpp"
#include "firmware/can/message_kind.hpp"
#include "firmware/can/operator_messages.hpp"
#include "firmware/can/pose_messages.hpp"
#include "firmware/can/rules_messages.hpp"
#include "firmware/can/signals.hpp"
#include "firmware/health.hpp"
#include "firmware/math/region.hpp"

namespace whisker::can {

constexpr uint8_t kProtocol = 1;

// Each message is a struct. each(m, f) calls f(signal, field) for the signals with fields, in the order of
// the table. kMore lists the signals after them: those of parts that another struct carries, and those that
// share a field with a signal of each().
// clang-format off
// {name, start, length, signed, min, max, factor, unit, about, part, word}

struct EStop {
  static constexpr MessageKind kKind = MessageKind::e_stop;
  uint8_t command = kStopCommand;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Command", 12, 4, false, 0, kClearCommand, "1", "", "only a clear in a valid frame clears", kAlways, stop_word}, m.command);
  }
};

struct Sync {
  static constexpr MessageKind kKind = MessageKind::sync;
  SyncMode sync_mode = SyncMode::real_time;
  uint32_t tick = 0;
  uint8_t period_ms = 10;
  uint8_t mission = 0;
  uint8_t gyro = 0;
  uint8_t fix = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Mode", 12, 2, false, 0, 1, "1", "", "the clock that drives the ticks", kAlways, word_in<kPaceWords>}, m.sync_mode);
    f({"Tick", 16, 32, false, 0, kMost32, "1", "", "the tick of this input set"}, m.tick);
    f({"Period", 48, 8, false, 1, kMost8, "0.001", "s", "control period"}, m.period_ms);
    f({"Mission", 56, 8, false, 0, kMost8, "1", "", "the mission that this tick belongs to"}, m.mission);
    f({"Gyro", 14, 1, false, 0, 1, "1", "", "1: the input set has a Gyro"}, m.gyro);
    f({"Fix", 15, 1, false, 0, 1, "1", "", "1: the input set has a Fix"}, m.fix);
  }
};

struct FaultReport {
  static constexpr MessageKind kKind = MessageKind::fault;
  Severity severity = Severity::none;
  uint16_t errors = 0;
  uint8_t core_fault = 0;
  uint16_t stops = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Severity", 12, 4, false, 0, 3, "1", "", "reaction of the sender", kAlways, word_in<kSeverityWords>}, m.severity);
    f({"Code", 16, 16, false, 0, kMost16, "1", "", "active error bits, as in Heartbeat"}, m.errors);
    f({"Detail", 32, 8, false, 0, kMost8, "1", "", "fault of the core", kAlways, word_of<Fault, kFaults>}, m.core_fault);
    f({"Count", 40, 16, false, 0, kMost16, "1", "", "safe stops since the start; saturates"}, m.stops);
  }
};

constexpr int32_t kPlaceLimitUm = kPlaceLimit.raw();
inline constexpr Signal kMissionPart = {"Part", 12, 4, false, 0, 6, "1", "", "one frame each", kMultiplexor, word_in<kMissionPartWords>};
inline constexpr Signal kToOperator = {"Operator", 15, 1, false, 0, 1, "1", "", "1: answers the operator; 0: the base"};
inline constexpr Signal kMissionNumber = {"Mission", 16, 8, false, 0, kMost8, "1", "", "number, a new one for every order"};

/// Part 0.
struct MissionOrder {
  static constexpr MessageKind kKind = MessageKind::mission;
  static constexpr Signal kMore[] = {
    {"StartX", 24, 32, true, -kPlaceLimitUm, kPlaceLimitUm, "0.000001", "m", "start pose of the robot", 1},
    {"StartY", 24, 32, true, -kPlaceLimitUm, kPlaceLimitUm, "0.000001", "m", "", 2},
    {"StartHeading", 24, 32, false, 0, kMost32, "8.381903171539306640625E-08", "deg", "counter-clockwise from x", 3},
    {"GoalX", 24, 32, true, -kPlaceLimitUm, kPlaceLimitUm, "0.000001", "m", "", 4},
    {"GoalY", 24, 32, true, -kPlaceLimitUm, kPlaceLimitUm, "0.000001", "m", "", 5},
    {"GoalTolerance", 24, 32, true, 1, INT32_MAX, "0.000001", "m", "reached within this distance", 6},
  };
  MissionPart part = MissionPart::order;
  uint8_t mission = 0;
  Order order = Order::start;
  uint16_t digest = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f(kMissionPart, m.part);
    f(kMissionNumber, m.mission);
    f({"Order", 24, 8, false, 0, kOrders - 1, "1", "", "executed once all other parts are received", 0, word_in<kOrderWords>}, m.order);
    f({"Digest", 32, 16, false, 0, kMost16, "1", "", "over the values of parts 1 to 6", 0}, m.digest);
  }
};

/// Parts 1 to 6. All values lie at the same bits as the heading. The range of a value is checked where its
/// part is known.
struct MissionValue {
  static constexpr MessageKind kKind = MessageKind::mission;
  MissionPart part = MissionPart::start_x;
  uint8_t mission = 0;
  uint32_t value = 0;  ///< raw, two's complement

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f(kMissionPart, m.part);
    f(kMissionNumber, m.mission);
    f(MissionOrder::kMore[2], m.value);
  }
};

struct MissionReply {
  static constexpr MessageKind kKind = MessageKind::mission_reply;
  MissionStatus status = MissionStatus::accepted;
  uint8_t mission = 0;
  uint8_t to_operator = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Status", 12, 3, false, 0, kMissionStatuses - 1, "1", "", "result of the order", kAlways, word_in<kMissionStatusWords>}, m.status);
    f({"Mission", 16, 8, false, 0, kMost8, "1", "", "of the order"}, m.mission);
    f(kToOperator, m.to_operator);
  }
};

struct WheelCommand {
  static constexpr MessageKind kKind = MessageKind::wheel_command;
  DriveMode mode = DriveMode::stop;
  hal::WheelSpeeds speeds{};
  uint16_t tick = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Mode", 12, 4, false, 0, 1, "1", "", "stop: brake to standstill, whatever the speeds", kAlways, word_in<kDriveWords>}, m.mode);
    f({"Left", 16, 16, true, -32767, 32767, "0.0001", "m/s", "rim speed, forward positive"}, m.speeds.left);
    f({"Right", 32, 16, true, -32767, 32767, "0.0001", "m/s", ""}, m.speeds.right);
    f({"Tick", 48, 16, false, 0, kMost16, "1", "", "of the answered input set, modulo 2^16"}, m.tick);
  }
};

struct WheelState {
  static constexpr MessageKind kKind = MessageKind::wheel_state;
  static constexpr uint8_t kTickModulus = 8;
  uint8_t valid = 1;
  uint8_t tick = 0;
  hal::EncoderCounts counts{};

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Valid", 12, 1, false, 0, 1, "1", "", "0: the encoders returned no counts"}, m.valid);
    f({"Tick", 13, 3, false, 0, 7, "1", "", "modulo 8"}, m.tick);
    f({"Left", 16, 24, false, 0, kMost24, "1", "", "encoder counts, modulo 2^24, forward positive"}, m.counts.left);
    f({"Right", 40, 24, false, 0, kMost24, "1", "", ""}, m.counts.right);
  }
};

/// Reading of one beam; the three messages differ in their identifiers only.
template <MessageKind kOf>
struct Range {
  static constexpr MessageKind kKind = kOf;
  static constexpr uint16_t kClear = 65535, kNone = 65534;
  hal::RangeReading
      reading{};  ///< reading.mm is the distance of the frame: kClear and kNone mean no distance
  uint16_t tick = 0;
  BumpState bump = BumpState::none;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Status", 12, 4, false, 0, 4, "1", "", "status of the reading", kAlways, word_in<kRangeWords>}, m.reading.status);
    f({"Distance", 16, 16, false, 0, kMost16, "0.001", "m", "65535: clear; 65534: no distance"}, m.reading.mm);
    f({"Age", 32, 8, false, 0, kMost8, "0.001", "s", "since the distance was true; 0.255 means that or more"}, m.reading.age_ms);
    f({"Sequence", 40, 4, false, 0, kMost4, "1", "", "increases with every new measurement"}, m.reading.sequence);
    f({"Bump", 44, 2, false, 0, 3, "1", "", "bump switch on this side", kAlways, word_in<kBumpWords>}, m.bump);
    f({"Tick", 48, 16, false, 0, kMost16, "1", "", "modulo 2^16"}, m.tick);
  }
};

struct NavStatus {
  static constexpr MessageKind kKind = MessageKind::nav_status;
  planning::Outcome outcome = planning::Outcome::none;
  planning::Mode state = planning::Mode::idle;
  uint8_t looked = 0;
  planning::Why why = planning::Why::none;
  uint8_t danger = 0;
  uint8_t fault = 0;
  uint16_t tick = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Outcome", 12, 4, false, 0, 4, "1", "", "of the mission", kAlways, word_in<kOutcomeWords>}, m.outcome);
    f({"State", 16, 5, false, 0, planning::kModes - 1, "1", "", "state of the planner", kAlways, word_of<planning::Mode, planning::kModes>}, m.state);
    f({"Looked", 21, 1, false, 0, 1, "1", "", "this tick's decision used a static scan"}, m.looked);
    f({"Why", 24, 8, false, 0, planning::kWhys - 1, "1", "", "reason of the state", kAlways, word_of<planning::Why, planning::kWhys>}, m.why);
    f({"Danger", 32, 8, false, 0, kMost8, "1", "", "positions since the target direction was last free"}, m.danger);
    f({"Fault", 40, 8, false, 0, kMost8, "1", "", "of the core", kAlways, word_of<Fault, kFaults>}, m.fault);
    f({"Tick", 48, 16, false, 0, kMost16, "1", "", "modulo 2^16"}, m.tick);
  }
};

struct ParamRequest {
  static constexpr MessageKind kKind = MessageKind::param_request;
  ParamAction action = ParamAction::read;
  uint8_t index = 0;
  uint32_t value = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Action", 12, 4, false, 0, 2, "1", "", "a change takes effect with commit", kAlways, word_in<kParamActionWords>}, m.action);
    f({"Index", 16, 8, false, 0, kMost8, "1", "", "of the parameter, see the list of parameters"}, m.index);
    f({"Value", 24, 32, false, 0, kMost32, "1", "", "raw, two's complement"}, m.value);
  }
};

struct ParamReply {
  static constexpr MessageKind kKind = MessageKind::param_reply;
  ParamStatus status = ParamStatus::ok;
  uint8_t index = 0;
  uint32_t value = 0;
  uint8_t to_operator = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Status", 12, 3, false, 0, 4, "1", "", "result of the request", kAlways, word_in<kParamStatusWords>}, m.status);
    f({"Index", 16, 8, false, 0, kMost8, "1", "", "of the request"}, m.index);
    f({"Value", 24, 32, false, 0, kMost32, "1", "", "current value; after commit: the parameter fault, or 0"}, m.value);
    f(kToOperator, m.to_operator);
  }
};

struct RangeTrustReport {
  static constexpr MessageKind kKind = MessageKind::range_trust;
  RangeLevel level = RangeLevel::trusted;
  uint16_t contradictions = 0;
  uint8_t phantoms = 0;
  uint8_t false_clears = 0;
  uint8_t incidence = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Level", 12, 4, false, 0, kRangeLevels - 1, "1", "", "how far the rangefinders do what the parameters say", kAlways, word_of<RangeLevel, kRangeLevels>}, m.level);
    f({"Contradictions", 16, 16, false, 0, kMost16, "0.00390625", "1/m", "echoes from ground shown empty, over the last 4 m"}, m.contradictions);
    f({"Phantoms", 32, 8, false, 0, kMost8, "0.00390625", "", "share of empty readings that show a near echo, worst beam"}, m.phantoms);
    f({"FalseClears", 40, 8, false, 0, kMost8, "0.00390625", "", "share of echoes missed, worst beam"}, m.false_clears);
    f({"Incidence", 48, 8, false, 0, 90, "1", "deg", "walls gave echoes up to this angle from their normal; 0: unknown"}, m.incidence);
  }
};

struct Heartbeat {
  static constexpr MessageKind kKind = MessageKind::heartbeat;
  NodeState state = NodeState::waiting;
  uint16_t errors = 0;
  uint16_t boot = 0;
  uint8_t protocol = kProtocol;
  uint8_t uptime_s = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"State", 12, 4, false, 0, 5, "1", "", "of the node", kAlways, word_in<kNodeStateWords>}, m.state);
    f({"Errors", 16, 16, false, 0, kMost16, "1", "", "one bit per error, see Errors"}, m.errors);
    f({"Boot", 32, 16, false, 0, kMost16, "1", "", "a new number at every start"}, m.boot);
    f({"Protocol", 48, 8, false, 0, kMost8, "1", "", "version of this protocol"}, m.protocol);
    f({"Uptime", 56, 8, false, 0, kMost8, "1", "s", "modulo 256"}, m.uptime_s);
  }
};

struct Info {
  static constexpr MessageKind kKind = MessageKind::info;
  static constexpr Signal kMore[] = {
    {"Version", 32, 24, false, 0, kMost24, "1", "", "of the firmware: major, minor, patch, one byte each", 1},
    {"RulesHash", 32, 32, false, 0, kMost32, "1", "", "of the controller's response table: CRC-32; the base sends none", 2},
  };
  InfoPart part = InfoPart::table_hash;
  uint16_t boot = 0;
  uint32_t value = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Part", 12, 4, false, 0, 2, "1", "", "one frame each", kMultiplexor, word_in<kInfoPartWords>}, m.part);
    f({"Boot", 16, 16, false, 0, kMost16, "1", "", "as in Heartbeat"}, m.boot);
    f({"TableHash", 32, 32, false, 0, kMost32, "1", "", "of this table", 0}, m.value);
  }
};

struct InfoRequest {
  static constexpr MessageKind kKind = MessageKind::info_request;
  static constexpr Signal kMore[] = {
    {"Reserved", 12, 4, false, 0, kMost4, "1", "", "not used"},
  };

  template <class M, class F>
  static constexpr void each(M&, F&) noexcept {}
};

struct Diagnostics {
  static constexpr MessageKind kKind = MessageKind::diagnostics;
  static constexpr Signal kMore[] = {
    {"Malformed", 16, 16, false, 0, kMost16, "1", "", "wrong length, remote, extended", 1},
    {"OutOfRange", 32, 16, false, 0, kMost16, "1", "", "frames with a value out of range", 1},
    {"Astray", 48, 16, false, 0, kMost16, "1", "", "frames whose counter jumped", 1},
    {"BusOffs", 16, 16, false, 0, kMost16, "1", "", "number of bus-off events", 2},
    {"Refused", 32, 16, false, 0, kMost16, "1", "", "frames that the port refused", 2},
    {"Expired", 48, 16, false, 0, kMost16, "1", "", "frames that were not sent in time", 2},
    {"Overrun", 16, 16, false, 0, kMost16, "1", "", "number of receive overruns in the node", 3},
    {"Skipped", 32, 16, false, 0, kMost16, "1", "", "ticks without a complete input set", 3},
    {"Stops", 48, 16, false, 0, kMost16, "1", "", "safe stops", 3},
  };
  uint8_t part = 0;
  uint16_t value[3] = {};

  template <class M, class F>
  static constexpr void each(M& m, F& f) noexcept {
    f({"Part", 12, 4, false, 0, 3, "1", "", "in turn", kMultiplexor, word_in<kDiagnosticsPartWords>}, m.part);
    f({"CrcErrors", 16, 16, false, 0, kMost16, "1", "", "frames with a wrong CRC", 0}, m.value[0]);
    f({"Lost", 32, 16, false, 0, kMost16, "1", "", "frames missed by their counters", 0}, m.value[1]);
    f({"Repeated", 48, 16, false, 0, kMost16, "1", "", "frames with the counter of the one before", 0}, m.value[2]);
  }
};

/// Calls visit(row, message) for each message, in the order of MessageKind.
template <class F>
constexpr void for_each_message(F&& visit) noexcept {
  // name, function, size, from controller, from base, cycle in ms, about
  visit(Message{"EStop", 0x01, 2, true, true, 0, "any data frame with this identifier stops, valid or not; node 0 stops all robots"}, EStop{});
  visit(Message{"Sync", 0x08, 8, false, true, 10, "last frame of an input set"}, Sync{});
  visit(Message{"Fault", 0x09, 7, true, true, 1000, "when an error bit changes, and once a second while one is active"}, FaultReport{});
  visit(Message{"Mission", 0x0A, 7, false, true, 0, "an order, repeated until answered", true}, MissionOrder{});
  visit(Message{"MissionReply", 0x0B, 3, true, false, 0, "answer to an order"}, MissionReply{});
  visit(Message{"Velocity", 0x0C, 6, false, false, 20, "velocity that the operator asks for; a guard node only", true}, VelocityCommand{});
  visit(Message{"Vouch", 0x0D, 5, false, false, 0, "the operator says that the ground around the robot is free; a guard node only", true}, VouchRequest{});
  visit(Message{"WheelCommand", 0x10, 8, true, false, 10, "answer to an input set, or stop"}, WheelCommand{});
  visit(Message{"WheelState", 0x11, 8, false, true, 10, "encoders"}, WheelState{});
  visit(Message{"RangeLeft", 0x12, 8, false, true, 10, "left rangefinder"}, Range<MessageKind::range_left>{});
  visit(Message{"RangeFront", 0x13, 8, false, true, 10, "middle rangefinder"}, Range<MessageKind::range_front>{});
  visit(Message{"RangeRight", 0x14, 8, false, true, 10, "right rangefinder"}, Range<MessageKind::range_right>{});
  visit(Message{"NavStatus", 0x15, 8, true, false, 10, "state of the navigation and its reason"}, NavStatus{});
  visit(Message{"ParamRequest", 0x16, 7, false, true, 0, "reads or changes a parameter", true}, ParamRequest{});
  visit(Message{"ParamReply", 0x17, 7, true, false, 0, "answer to a ParamRequest"}, ParamReply{});
  visit(Message{"RangeTrust", 0x1A, 7, true, false, 500, "what the core measures of its rangefinders; also at every change of the level"}, RangeTrustReport{});
  visit(Message{"PoseSigma", 0x1B, 8, true, false, 500, "how far the pose may be off, if the parameters declare an error of the wheels; also at the end of the mission"}, PoseSigmaReport{});
  visit(Message{"Gyro", 0x1C, 8, false, true, 10, "gyro; only where one is fitted"}, GyroState{});
  visit(Message{"Fix", 0x1D, 8, false, true, 0, "a pose measured outside of the robot"}, FixValue{});
  visit(Message{"FixReply", 0x1E, 8, true, false, 0, "answer to a Fix"}, FixReply{});
  visit(Message{"GuardStatus", 0x1F, 8, true, false, 10, "what a guard node grants; every 100 ms while it does not drive"}, GuardReport{});
  visit(Message{"RulesPart", 0x20, 8, false, true, 0, "a node of a response table"}, RulesPart{});
  visit(Message{"RulesOrder", 0x21, 7, false, true, 0, "activates a response table, repeated until answered"}, RulesOrder{});
  visit(Message{"RulesReply", 0x22, 5, true, false, 0, "answer to a RulesOrder, and to every eighth RulesPart"}, RulesReply{});
  visit(Message{"Calibration", 0x23, 8, true, false, 500, "a value that the controller's storage has, and what became of the last calibration; the four values in turn; only of a controller that calibrates"}, CalibrationReport{});
  visit(Message{"Heartbeat", 0x70, 8, true, true, 100, "the node is alive, and its state"}, Heartbeat{});
  visit(Message{"Info", 0x71, 8, true, true, 0, "at the start, and on request"}, Info{});
  visit(Message{"InfoRequest", 0x72, 2, true, true, 0, "requests the Info of the other node"}, InfoRequest{});
  visit(Message{"Diagnostics", 0x73, 8, true, true, 500, "counters; each saturates"}, Diagnostics{});
}
// clang-format on

}  // namespace whisker::can
