/// The messages as structs. each(m, f) calls f(signal, field) for the signals of a message.
#pragma once

#include <stdint.h>

#include "firmware/can/codec.hpp"

namespace whisker::can {

struct EStop {
  static constexpr Kind kKind = Kind::e_stop;
  uint8_t command = kStopCommand;

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kEStop[0], m.command);
  }
};

struct Sync {
  static constexpr Kind kKind = Kind::sync;
  Pace pace = Pace::real_time;
  uint32_t tick = 0;
  uint8_t period_ms = 10;
  uint8_t mission = 0;

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kSync[0], m.pace);
    f(kSync[1], m.tick);
    f(kSync[2], m.period_ms);
    f(kSync[3], m.mission);
  }
};

struct FaultReport {
  static constexpr Kind kKind = Kind::fault;
  Severity severity = Severity::none;
  uint16_t errors = 0;
  uint8_t core_fault = 0;
  uint16_t stops = 0;

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kFault[0], m.severity);
    f(kFault[1], m.errors);
    f(kFault[2], m.core_fault);
    f(kFault[3], m.stops);
  }
};

/// Part 0.
struct MissionOrder {
  static constexpr Kind kKind = Kind::mission;
  MissionPart part = MissionPart::order;
  uint8_t mission = 0;
  Order order = Order::start;
  uint16_t digest = 0;

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kMission[0], m.part);
    f(kMission[1], m.mission);
    f(kMission[2], m.order);
    f(kMission[3], m.digest);
  }
};

/// Parts 1 to 6. The range of a value is checked where its part is known.
struct MissionValue {
  static constexpr Kind kKind = Kind::mission;
  static constexpr const Signal& kHeading = kMission[6];
  MissionPart part = MissionPart::start_x;
  uint8_t mission = 0;
  uint32_t value = 0;  ///< raw, two's complement

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kMission[0], m.part);
    f(kMission[1], m.mission);
    f(kHeading, m.value);
  }
};

struct MissionReply {
  static constexpr Kind kKind = Kind::mission_reply;
  MissionStatus status = MissionStatus::accepted;
  uint8_t mission = 0;

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kMissionReply[0], m.status);
    f(kMissionReply[1], m.mission);
  }
};

struct WheelCommand {
  static constexpr Kind kKind = Kind::wheel_command;
  DriveMode mode = DriveMode::stop;
  hal::WheelSpeeds speeds{};
  uint16_t tick = 0;

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kWheelCommand[0], m.mode);
    f(kWheelCommand[1], m.speeds.left);
    f(kWheelCommand[2], m.speeds.right);
    f(kWheelCommand[3], m.tick);
  }
};

struct WheelState {
  static constexpr Kind kKind = Kind::wheel_state;
  static constexpr uint8_t kTickModulus = 8;
  uint8_t valid = 1;
  uint8_t tick = 0;
  hal::EncoderCounts counts{};

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kWheelState[0], m.valid);
    f(kWheelState[1], m.tick);
    f(kWheelState[2], m.counts.left);
    f(kWheelState[3], m.counts.right);
  }
};

/// Reading of one beam; the three messages differ in their identifiers only.
template <Kind kOf>
struct Range {
  static constexpr Kind kKind = kOf;
  static constexpr uint16_t kClear = 65535, kNone = 65534;
  hal::RangeReading
      reading{};  ///< reading.mm is the distance of the frame: kClear and kNone mean no distance
  uint16_t tick = 0;

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kRange[0], m.reading.status);
    f(kRange[1], m.reading.mm);
    f(kRange[2], m.reading.age_ms);
    f(kRange[3], m.reading.sequence);
    f(kRange[4], m.tick);
  }
};

struct NavStatus {
  static constexpr Kind kKind = Kind::nav_status;
  planning::Outcome outcome = planning::Outcome::none;
  planning::Mode state = planning::Mode::idle;
  uint8_t looked = 0;
  planning::Why why = planning::Why::none;
  uint8_t danger = 0;
  uint8_t fault = 0;
  uint16_t tick = 0;

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kNavStatus[0], m.outcome);
    f(kNavStatus[1], m.state);
    f(kNavStatus[2], m.looked);
    f(kNavStatus[3], m.why);
    f(kNavStatus[4], m.danger);
    f(kNavStatus[5], m.fault);
    f(kNavStatus[6], m.tick);
  }
};

struct ParamRequest {
  static constexpr Kind kKind = Kind::param_request;
  ParamAction action = ParamAction::read;
  uint8_t index = 0;
  uint32_t value = 0;

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kParamRequest[0], m.action);
    f(kParamRequest[1], m.index);
    f(kParamRequest[2], m.value);
  }
};

struct ParamReply {
  static constexpr Kind kKind = Kind::param_reply;
  ParamStatus status = ParamStatus::ok;
  uint8_t index = 0;
  uint32_t value = 0;

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kParamReply[0], m.status);
    f(kParamReply[1], m.index);
    f(kParamReply[2], m.value);
  }
};

struct Heartbeat {
  static constexpr Kind kKind = Kind::heartbeat;
  NodeState state = NodeState::waiting;
  uint16_t errors = 0;
  uint16_t boot = 0;
  uint8_t protocol = kProtocol;
  uint8_t uptime_s = 0;

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kHeartbeat[0], m.state);
    f(kHeartbeat[1], m.errors);
    f(kHeartbeat[2], m.boot);
    f(kHeartbeat[3], m.protocol);
    f(kHeartbeat[4], m.uptime_s);
  }
};

struct Info {
  static constexpr Kind kKind = Kind::info;
  InfoPart part = InfoPart::table_hash;
  uint16_t boot = 0;
  uint32_t value = 0;

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kInfo[0], m.part);
    f(kInfo[1], m.boot);
    f(kInfo[2], m.value);
  }
};

struct InfoRequest {
  static constexpr Kind kKind = Kind::info_request;

  template <class M, class F>
  static void each(M&, F&) noexcept {}
};

struct Diagnostics {
  static constexpr Kind kKind = Kind::diagnostics;
  uint8_t part = 0;
  uint16_t value[3] = {};

  template <class M, class F>
  static void each(M& m, F& f) noexcept {
    f(kDiagnostics[0], m.part);
    f(kDiagnostics[1], m.value[0]);
    f(kDiagnostics[2], m.value[1]);
    f(kDiagnostics[3], m.value[2]);
  }
};

}  // namespace whisker::can
