/// Enumerations of the protocol and their names.
#pragma once

#include <stdint.h>

#include "firmware/planning/planner.hpp"
#include "firmware/planning/state.hpp"
#include "hal/types.hpp"

namespace whisker::can {

constexpr uint8_t kStopCommand = 0, kClearCommand = 10;

enum class SyncMode : uint8_t {
  real_time,  ///< ticks follow the clock
  lockstep,   ///< the base waits for the answer to each tick; no time-out applies to ticks
};
inline constexpr const char* kPaceWords[] = {"real_time", "lockstep"};

enum class Severity : uint8_t { none, holding, stopped, latched };
inline constexpr const char* kSeverityWords[] = {"none", "holding", "stopped", "latched"};

enum class MissionPart : uint8_t { order, start_x, start_y, start_heading, goal_x, goal_y, goal_tolerance };
inline constexpr const char* kMissionPartWords[] = {"order",  "start_x", "start_y",       "start_heading",
                                                    "goal_x", "goal_y",  "goal_tolerance"};
constexpr int kMissionValues = 6;

enum class Order : uint8_t {
  start,     ///< place the robot and drive to the goal
  cancel,    ///< stop, and clear the goal
  resume,    ///< drive to the goal from the estimated pose; ends a safe stop
  spin,      ///< calibrate: place the robot and turn on the spot
  straight,  ///< calibrate: place the robot, drive straight ahead as far as the goal is away, and back
  tape,      ///< calibrate: the same one way, along a tape
  measured,  ///< calibrate: as far as the goal is away, the robot has gone by the tape; drives nothing
};
constexpr int kOrders = 7;
inline constexpr const char* kOrderWords[] = {"start",    "cancel", "resume",  "spin",
                                              "straight", "tape",   "measured"};
constexpr bool calibrates(Order order) noexcept { return order >= Order::spin; }
/// The robot runs once it is accepted.
constexpr bool drives(Order order) noexcept { return order != Order::cancel && order != Order::measured; }

enum class MissionStatus : uint8_t {
  accepted,
  incomplete,    ///< parts are missing, or do not match the digest: send all again
  refused,       ///< E-stop, no handshake, or inconsistent parameters
  unknown,       ///< resume without a mission
  out_of_range,  ///< start or goal lies beyond the limit, a value is invalid, or a straight drive is too
                 ///< short
  unsupported,   ///< this controller does not calibrate
};
constexpr int kMissionStatuses = 6;
inline constexpr const char* kMissionStatusWords[] = {"accepted", "incomplete",   "refused",
                                                      "unknown",  "out_of_range", "unsupported"};

enum class FixPart : uint8_t { x, y, heading, sigma_along, sigma_across, sigma_heading };
inline constexpr const char* kFixPartWords[] = {
    "x", "y", "heading", "sigma_along", "sigma_across", "sigma_heading"};
constexpr int kFixValues = 6;

enum class FixStatus : uint8_t {
  accepted,
  refused,       ///< a jump, and the parameter fix_jumps is refuse: nothing was changed
  out_of_range,  ///< beyond the limit of a place: a fault
};
inline constexpr const char* kFixStatusWords[] = {"accepted", "refused", "out_of_range"};

enum class DriveMode : uint8_t { stop, drive };
inline constexpr const char* kDriveWords[] = {"stop", "drive"};

enum class ParamAction : uint8_t { read, write, commit };
inline constexpr const char* kParamActionWords[] = {"read", "write", "commit"};

enum class ParamStatus : uint8_t {
  ok,
  no_such,       ///< no parameter has this index
  out_of_range,  ///< nothing was changed
  busy,          ///< a mission runs: nothing was changed
  inconsistent,  ///< commit: the parameters are inconsistent
};
inline constexpr const char* kParamStatusWords[] = {"ok", "no_such", "out_of_range", "busy", "inconsistent"};

enum class RulesAction : uint8_t {
  activate,  ///< drive with the table of this hash
  restore,   ///< drive with the controller's built-in table
};
inline constexpr const char* kRulesActionWords[] = {"activate", "restore"};

enum class RulesStatus : uint8_t {
  receiving,    ///< a part came
  activated,    ///< the order is executed
  incomplete,   ///< parts are missing: send them from Next on
  wrong_hash,   ///< the parts have another hash than the order: send all again
  running,      ///< a mission runs: nothing was changed
  moving,       ///< the wheels turned within the last 100 ms: nothing was changed
  unsupported,  ///< this controller has no room for a table
};
constexpr int kRulesStatuses = 7;
inline constexpr const char* kRulesStatusWords[] = {"receiving", "activated", "incomplete", "wrong_hash",
                                                    "running",   "moving",    "unsupported"};

enum class NodeState : uint8_t {
  off_bus,    ///< the port is not on the bus
  waiting,    ///< no other node, or none with this protocol
  ready,      ///< the handshake matched
  running,    ///< commands drive the wheels
  safe_stop,  ///< latched: wheels brake and stand until a new order
  e_stopped,  ///< latched: until a valid clear
};
inline constexpr const char* kNodeStateWords[] = {"off_bus", "waiting",   "ready",
                                                  "running", "safe_stop", "e_stopped"};

enum class InfoPart : uint8_t { table_hash, version, rules_hash };
inline constexpr const char* kInfoPartWords[] = {"table_hash", "version", "rules_hash"};

/// Bits of Errors in Heartbeat. The first group latches a safe stop.
struct Error {
  enum Bit : uint16_t {
    command_late = 1 << 0,     ///< base: no valid command for too long
    odometry_late = 1 << 1,    ///< controller: no valid counts for too long
    range_late = 1 << 2,       ///< controller: no valid range of a beam for too long
    peer_lost = 1 << 3,        ///< no heartbeat of the other node for too long
    bus_off = 1 << 4,          ///< the port left the bus
    bus_off_latched = 1 << 5,  ///< too many bus-offs: it stays off until the node restarts
    peer_restarted = 1 << 6,   ///< the other node has a new boot number
    peer_stopped = 1 << 7,     ///< the other node is in a safe stop
    duplicate_node = 1 << 8,   ///< another node sends with this node's number
    e_stop = 1 << 9,
    wrong_version = 1 << 10,    ///< the other node has another protocol or table
    core_fault = 1 << 11,       ///< see NavStatus
    drive_refused = 1 << 12,    ///< base: the drive refused a command
    sensors_refused = 1 << 13,  ///< base: the rangefinders did not answer
    gyro_refused = 1 << 14,     ///< base: the gyro did not answer
  };
};

/// The names of the bits of Errors, from bit 0.
inline constexpr const char* kErrorWords[] = {
    "command_late",    "odometry_late",  "range_late",    "peer_lost",       "bus_off",
    "bus_off_latched", "peer_restarted", "peer_stopped",  "duplicate_node",  "e_stop",
    "wrong_version",   "core_fault",     "drive_refused", "sensors_refused", "gyro_refused"};

/// Of the bump switch beside a beam.
enum class BumpState : uint8_t {
  none,  ///< no bumper
  open,
  pressed,
  unknown,  ///< the bumper gave no state
};
inline constexpr const char* kGuardReasonWords[] = {"clear",   "fault",    "stale_ranges", "command_timeout",
                                                    "nodding", "obstacle", "unseen",       "doubt",
                                                    "limits",  "assisted"};
inline constexpr const char* kHeadingWords[] = {"wheels", "bias_unknown", "gyro", "gyro_lost"};
inline constexpr const char* kBumpWords[] = {"none", "open", "pressed", "unknown"};

// Names of values whose types belong to the hardware interface or to the planner.
inline constexpr const char* kRangeWords[] = {"ok", "clear", "too_near", "invalid", "stale"};
inline constexpr const char* kOutcomeWords[] = {"none", "running", "reached", "unreachable", "gave_up"};
inline constexpr const char* kDiagnosticsPartWords[] = {"content", "format", "sending", "receiving"};

/// The name of a raw value; nullptr for a value without a name.
template <const auto& kWords>
const char* word_in(int64_t raw) noexcept {
  return raw >= 0 && raw < int64_t{sizeof kWords / sizeof *kWords} ? kWords[raw] : nullptr;
}
/// The name of a raw value of an enumeration with its own name().
template <class E, int kCount>
const char* word_of(int64_t raw) noexcept {
  return raw >= 0 && raw < kCount ? name(static_cast<E>(raw)) : nullptr;
}
inline const char* stop_word(int64_t raw) noexcept {
  return raw == kStopCommand ? "stop" : raw == kClearCommand ? "clear" : nullptr;
}

}  // namespace whisker::can
