#include "firmware/can/words.hpp"

#include <stddef.h>

#include "firmware/health.hpp"

namespace whisker::can {
namespace {

template <size_t kCount>
const char* pick(const char* const (&names)[kCount], int64_t raw) noexcept {
  return raw >= 0 && raw < static_cast<int64_t>(kCount) ? names[raw] : nullptr;
}

}  // namespace

const char* stop_word(int64_t raw) noexcept {
  return raw == kStopCommand ? "stop" : raw == kClearCommand ? "clear" : nullptr;
}

const char* sync_word(int64_t raw) noexcept {
  constexpr const char* kNames[] = {"real_time", "lockstep"};
  return pick(kNames, raw);
}

const char* severity_word(int64_t raw) noexcept {
  constexpr const char* kNames[] = {"none", "holding", "stopped", "latched"};
  return pick(kNames, raw);
}

const char* fault_word(int64_t raw) noexcept {
  return raw >= 0 && raw < kFaults ? whisker::name(static_cast<Fault>(raw)) : nullptr;
}

const char* mission_part_word(int64_t raw) noexcept {
  constexpr const char* kNames[] = {"order",  "start_x", "start_y",       "start_heading",
                                    "goal_x", "goal_y",  "goal_tolerance"};
  return pick(kNames, raw);
}

const char* order_word(int64_t raw) noexcept {
  constexpr const char* kNames[] = {"start", "cancel", "resume"};
  return pick(kNames, raw);
}

const char* mission_status_word(int64_t raw) noexcept {
  constexpr const char* kNames[] = {"accepted", "incomplete", "refused", "unknown", "out_of_range"};
  return pick(kNames, raw);
}

const char* drive_word(int64_t raw) noexcept {
  constexpr const char* kNames[] = {"stop", "drive"};
  return pick(kNames, raw);
}

const char* range_word(int64_t raw) noexcept {
  constexpr const char* kNames[] = {"ok", "clear", "too_near", "invalid", "stale"};
  return pick(kNames, raw);
}

const char* outcome_word(int64_t raw) noexcept {
  constexpr const char* kNames[] = {"none", "running", "reached", "unreachable", "gave_up"};
  return pick(kNames, raw);
}

const char* state_word(int64_t raw) noexcept {
  return raw >= 0 && raw < planning::kModes ? planning::name(static_cast<planning::Mode>(raw)) : nullptr;
}

const char* why_word(int64_t raw) noexcept {
  return raw >= 0 && raw < planning::kWhys ? planning::name(static_cast<planning::Why>(raw)) : nullptr;
}

const char* param_action_word(int64_t raw) noexcept {
  constexpr const char* kNames[] = {"read", "write", "commit"};
  return pick(kNames, raw);
}

const char* param_status_word(int64_t raw) noexcept {
  constexpr const char* kNames[] = {"ok", "no_such", "out_of_range", "busy", "inconsistent"};
  return pick(kNames, raw);
}

const char* node_state_word(int64_t raw) noexcept {
  constexpr const char* kNames[] = {"off_bus", "waiting", "ready", "running", "safe_stop", "e_stopped"};
  return pick(kNames, raw);
}

const char* info_part_word(int64_t raw) noexcept {
  constexpr const char* kNames[] = {"table_hash", "version"};
  return pick(kNames, raw);
}

const char* diagnostics_part_word(int64_t raw) noexcept {
  constexpr const char* kNames[] = {"content", "format", "sending", "receiving"};
  return pick(kNames, raw);
}

const char* error_word(int64_t bit) noexcept {
  constexpr const char* kNames[] = {"command_late",   "odometry_late",   "range_late",     "peer_lost",
                                    "bus_off",        "bus_off_latched", "peer_restarted", "peer_stopped",
                                    "duplicate_node", "e_stop",          "wrong_version",  "core_fault",
                                    "drive_refused",  "sensors_refused"};
  return pick(kNames, bit);
}

}  // namespace whisker::can
