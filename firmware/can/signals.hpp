/// The table of the protocol: every message and its signals. The codec uses it at compile time;
/// whisker.dbc and docs/protocol.md are generated from it.
///
/// All signals are little-endian: bit n is bit n % 8 of byte n / 8, and a signal starts with its lowest bit.
/// Every message also has Crc (bits 0 to 7) and Counter (bits 8 to 11), see e2e.hpp.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "firmware/can/words.hpp"
#include "firmware/math/region.hpp"

namespace whisker::can {

constexpr uint8_t kProtocol = 1;

constexpr int8_t kAlways = -1;       ///< Signal::part of a signal in every frame
constexpr int8_t kMultiplexor = -2;  ///< Signal::part of the signal that selects the part

using Word = const char* (*)(int64_t raw) noexcept;

struct Signal {
  const char* name = nullptr;
  uint8_t start = 0;       ///< lowest bit
  uint8_t length = 0;      ///< 1..32 bits
  bool is_signed = false;  ///< two's complement
  int64_t min = 0;         ///< raw; a frame with a value outside [min, max] is ignored
  int64_t max = 0;
  const char* factor = nullptr;  ///< physical value = raw x factor
  const char* unit = nullptr;
  const char* about = nullptr;
  int8_t part = kAlways;
  Word word = nullptr;  ///< names of the values
};

struct Message {
  const char* name;
  uint8_t function;  ///< of the identifier
  uint8_t size;      ///< bytes
  bool from_controller;
  bool from_base;
  uint16_t cycle_ms;  ///< 0: on an event
  const char* about;
  const Signal* signals;
  uint8_t count;
};

constexpr int64_t kMost4 = 15, kMost8 = 255, kMost16 = 65535, kMost24 = 0xFFFFFF, kMost32 = 0xFFFFFFFF;

// clang-format off
//  name, start, length, signed, min, max, factor, unit, about, part, word
inline constexpr Signal kEStop[] = {
  {"Command", 12, 4, false, 0, kClearCommand, "1", "", "only a clear in a valid frame clears", kAlways, stop_word},
};

inline constexpr Signal kSync[] = {
  {"Mode",     12,  4, false, 0, 1,       "1",     "",  "the clock that drives the ticks", kAlways, sync_word},
  {"Tick",     16, 32, false, 0, kMost32, "1",     "",  "the tick of this input set"},
  {"Period",   48,  8, false, 1, kMost8,  "0.001", "s", "control period"},
  {"Mission",  56,  8, false, 0, kMost8,  "1",     "",  "the mission that this tick belongs to"},
};

inline constexpr Signal kFault[] = {
  {"Severity", 12,  4, false, 0, 3,       "1", "", "reaction of the sender", kAlways, severity_word},
  {"Code",     16, 16, false, 0, kMost16, "1", "", "active error bits, as in Heartbeat"},
  {"Detail",   32,  8, false, 0, kMost8,  "1", "", "fault of the core", kAlways, fault_word},
  {"Count",    40, 16, false, 0, kMost16, "1", "", "safe stops since the start; saturates"},
};

constexpr int32_t kPlaceLimitUm = kPlaceLimit.raw();

inline constexpr Signal kMission[] = {
  {"Part",          12,  4, false, 0, 6,                 "1",                           "",    "one frame each", kMultiplexor, mission_part_word},
  {"Mission",       16,  8, false, 0, kMost8,            "1",                           "",    "number, a new one for every order"},
  {"Order",         24,  8, false, 0, 2,                 "1",                           "",    "executed once all other parts are received", 0, order_word},
  {"Digest",        32, 16, false, 0, kMost16,           "1",                           "",    "over the values of parts 1 to 6", 0},
  {"StartX",        24, 32, true,  -kPlaceLimitUm, kPlaceLimitUm, "0.000001",                    "m",   "start pose of the robot", 1},
  {"StartY",        24, 32, true,  -kPlaceLimitUm, kPlaceLimitUm, "0.000001",                    "m",   "", 2},
  {"StartHeading",  24, 32, false, 0, kMost32,           "8.381903171539306640625E-08", "deg", "counter-clockwise from x", 3},
  {"GoalX",         24, 32, true,  -kPlaceLimitUm, kPlaceLimitUm, "0.000001",                    "m",   "", 4},
  {"GoalY",         24, 32, true,  -kPlaceLimitUm, kPlaceLimitUm, "0.000001",                    "m",   "", 5},
  {"GoalTolerance", 24, 32, true,  1, INT32_MAX,         "0.000001",                    "m",   "reached within this distance", 6},
};

inline constexpr Signal kMissionReply[] = {
  {"Status",  12,  4, false, 0, 4,       "1", "", "result of the order", kAlways, mission_status_word},
  {"Mission", 16,  8, false, 0, kMost8,  "1", "", "of the order"},
};

inline constexpr Signal kWheelCommand[] = {
  {"Mode",  12,  4, false, 0, 1,           "1",      "",    "stop: brake to standstill, whatever the speeds", kAlways, drive_word},
  {"Left",  16, 16, true,  -32767, 32767,  "0.0001", "m/s", "rim speed, forward positive"},
  {"Right", 32, 16, true,  -32767, 32767,  "0.0001", "m/s", ""},
  {"Tick",  48, 16, false, 0, kMost16,     "1",      "",    "of the answered input set, modulo 2^16"},
};

inline constexpr Signal kWheelState[] = {
  {"Valid", 12,  1, false, 0, 1,       "1", "", "0: the encoders returned no counts"},
  {"Tick",  13,  3, false, 0, 7,       "1", "", "modulo 8"},
  {"Left",  16, 24, false, 0, kMost24, "1", "", "encoder counts, modulo 2^24, forward positive"},
  {"Right", 40, 24, false, 0, kMost24, "1", "", ""},
};

inline constexpr Signal kRange[] = {
  {"Status",   12,  4, false, 0, 4,       "1",     "",  "status of the reading", kAlways, range_word},
  {"Distance", 16, 16, false, 0, kMost16, "0.001", "m", "65535: clear; 65534: no distance"},
  {"Age",      32,  8, false, 0, kMost8,  "0.001", "s", "since the distance was true; 0.255 means that or more"},
  {"Sequence", 40,  4, false, 0, kMost4,  "1",     "",  "increases with every new measurement"},
  {"Tick",     48, 16, false, 0, kMost16, "1",     "",  "modulo 2^16"},
};

inline constexpr Signal kNavStatus[] = {
  {"Outcome", 12,  4, false, 0, 4,             "1", "", "of the mission", kAlways, outcome_word},
  {"State",   16,  5, false, 0, planning::kModes - 1, "1", "", "state of the planner", kAlways, state_word},
  {"Looked",  21,  1, false, 0, 1,             "1", "", "this tick's decision used a static scan"},
  {"Why",     24,  8, false, 0, planning::kWhys - 1, "1", "", "reason of the state", kAlways, why_word},
  {"Danger",  32,  8, false, 0, kMost8,        "1", "", "positions since the target direction was last free"},
  {"Fault",   40,  8, false, 0, kMost8,        "1", "", "of the core", kAlways, fault_word},
  {"Tick",    48, 16, false, 0, kMost16,       "1", "", "modulo 2^16"},
};

inline constexpr Signal kParamRequest[] = {
  {"Action", 12,  4, false, 0, 2,       "1", "", "a change takes effect with commit", kAlways, param_action_word},
  {"Index",  16,  8, false, 0, kMost8,  "1", "", "of the parameter, see the list of parameters"},
  {"Value",  24, 32, false, 0, kMost32, "1", "", "raw, two's complement"},
};

inline constexpr Signal kParamReply[] = {
  {"Status", 12,  4, false, 0, 4,       "1", "", "result of the request", kAlways, param_status_word},
  {"Index",  16,  8, false, 0, kMost8,  "1", "", "of the request"},
  {"Value",  24, 32, false, 0, kMost32, "1", "", "current value; after commit: the parameter fault, or 0"},
};

inline constexpr Signal kHeartbeat[] = {
  {"State",    12,  4, false, 0, 5,       "1", "",  "of the node", kAlways, node_state_word},
  {"Errors",   16, 16, false, 0, kMost16, "1", "",  "one bit per error, see Errors"},
  {"Boot",     32, 16, false, 0, kMost16, "1", "",  "a new number at every start"},
  {"Protocol", 48,  8, false, 0, kMost8,  "1", "",  "version of this protocol"},
  {"Uptime",   56,  8, false, 0, kMost8,  "1", "s", "modulo 256"},
};

inline constexpr Signal kInfo[] = {
  {"Part",      12,  4, false, 0, 1,       "1", "", "one frame each", kMultiplexor, info_part_word},
  {"Boot",      16, 16, false, 0, kMost16, "1", "", "as in Heartbeat"},
  {"TableHash", 32, 32, false, 0, kMost32, "1", "", "of this table", 0},
  {"Version",   32, 24, false, 0, kMost24, "1", "", "of the firmware: major, minor, patch, one byte each", 1},
};

inline constexpr Signal kInfoRequest[] = {
  {"Reserved", 12, 4, false, 0, kMost4, "1", "", "not used"},
};

inline constexpr Signal kDiagnostics[] = {
  {"Part",       12,  4, false, 0, 3,       "1", "", "in turn", kMultiplexor, diagnostics_part_word},
  {"CrcErrors",  16, 16, false, 0, kMost16, "1", "", "frames with a wrong CRC", 0},
  {"Lost",       32, 16, false, 0, kMost16, "1", "", "frames missed by their counters", 0},
  {"Repeated",   48, 16, false, 0, kMost16, "1", "", "frames with the counter of the one before", 0},
  {"Malformed",  16, 16, false, 0, kMost16, "1", "", "wrong length, remote, extended", 1},
  {"OutOfRange", 32, 16, false, 0, kMost16, "1", "", "frames with a value out of range", 1},
  {"Astray",     48, 16, false, 0, kMost16, "1", "", "frames whose counter jumped", 1},
  {"BusOffs",    16, 16, false, 0, kMost16, "1", "", "number of bus-off events", 2},
  {"Refused",    32, 16, false, 0, kMost16, "1", "", "frames that the port refused", 2},
  {"Expired",    48, 16, false, 0, kMost16, "1", "", "frames that were not sent in time", 2},
  {"Overrun",    16, 16, false, 0, kMost16, "1", "", "number of receive overruns in the node", 3},
  {"Skipped",    32, 16, false, 0, kMost16, "1", "", "ticks without a complete input set", 3},
  {"Stops",      48, 16, false, 0, kMost16, "1", "", "safe stops", 3},
};
// clang-format on

/// Messages in the order of the table below.
enum class Kind : uint8_t {
  e_stop,
  sync,
  fault,
  mission,
  mission_reply,
  wheel_command,
  wheel_state,
  range_left,
  range_front,
  range_right,
  nav_status,
  param_request,
  param_reply,
  heartbeat,
  info,
  info_request,
  diagnostics,
};
constexpr int kKinds = 17;

template <size_t kCount>
constexpr Message message(const char* name, uint8_t function, uint8_t size, bool from_controller,
                          bool from_base, uint16_t cycle_ms, const char* about,
                          const Signal (&signals)[kCount]) noexcept {
  return {name,
          function,
          size,
          from_controller,
          from_base,
          cycle_ms,
          about,
          signals,
          static_cast<uint8_t>(kCount)};
}

// clang-format off
//  name, function, size, from controller, from base, cycle in ms, about, signals
inline constexpr Message kMessages[kKinds] = {
  message("EStop",        0x01, 2, true,  true,  0,   "any data frame with this identifier stops, valid or not; node 0 stops all robots", kEStop),
  message("Sync",         0x08, 8, false, true,  10,  "last frame of an input set", kSync),
  message("Fault",        0x09, 7, true,  true,  1000, "when an error bit changes, and once a second while one is active", kFault),
  message("Mission",      0x0A, 7, false, true,  0,   "an order, repeated until answered", kMission),
  message("MissionReply", 0x0B, 3, true,  false, 0,   "answer to an order", kMissionReply),
  message("WheelCommand", 0x10, 8, true,  false, 10,  "answer to an input set, or stop", kWheelCommand),
  message("WheelState",   0x11, 8, false, true,  10,  "encoders", kWheelState),
  message("RangeLeft",    0x12, 8, false, true,  10,  "left rangefinder", kRange),
  message("RangeFront",   0x13, 8, false, true,  10,  "middle rangefinder", kRange),
  message("RangeRight",   0x14, 8, false, true,  10,  "right rangefinder", kRange),
  message("NavStatus",    0x15, 8, true,  false, 10,  "state of the navigation and its reason", kNavStatus),
  message("ParamRequest", 0x16, 7, false, true,  0,   "reads or changes a parameter", kParamRequest),
  message("ParamReply",   0x17, 7, true,  false, 0,   "answer to a ParamRequest", kParamReply),
  message("Heartbeat",    0x70, 8, true,  true,  100, "the node is alive, and its state", kHeartbeat),
  message("Info",         0x71, 8, true,  true,  0,   "at the start, and on request", kInfo),
  message("InfoRequest",  0x72, 2, true,  true,  0,   "requests the Info of the other node", kInfoRequest),
  message("Diagnostics",  0x73, 8, true,  true,  500, "counters; each saturates", kDiagnostics),
};
// clang-format on

constexpr const Message& message_of(Kind kind) noexcept { return kMessages[static_cast<uint8_t>(kind)]; }

}  // namespace whisker::can
