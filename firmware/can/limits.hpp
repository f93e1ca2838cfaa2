/// Times of the protocol in ms. A node that is polled every millisecond exceeds each by at most one.
#pragma once

#include <stdint.h>

namespace whisker::can {

constexpr uint32_t kHoldAfter_ms = 30;        ///< range of a beam missing: brake, continue when it returns
constexpr uint32_t kRangeLatch_ms = 100;      ///< still missing: safe stop
constexpr uint32_t kOdometryLate_ms = 50;     ///< no counts, or no complete input set: safe stop
constexpr uint32_t kCommandLate_ms = 49;      ///< no command: safe stop at the 50th
constexpr uint32_t kVelocityLate_ms = 50;     ///< no Velocity: the guard brakes, and goes on with the next
constexpr uint32_t kCommandOld_ms = 50;       ///< a command for older measurements is ignored
constexpr uint32_t kPeerLost_ms = 300;        ///< no heartbeat: safe stop
constexpr uint32_t kHeartbeat_ms = 100;       ///< period of the own heartbeat
constexpr uint32_t kFaultRepeat_ms = 1000;    ///< period of Fault frames while an error is active
constexpr uint32_t kDiagnostics_ms = 500;     ///< period of Diagnostics frames
constexpr uint32_t kStopRepeat_ms = 10;       ///< period of stop commands
constexpr uint32_t kOrderRepeat_ms = 50;      ///< period of an unanswered order
constexpr uint32_t kRulesRepeat_ms = 100;     ///< delay before an unanswered block or RulesOrder is repeated
constexpr uint32_t kRestartAfter_ms = 100;    ///< delay after bus-off
constexpr uint32_t kBusOffWindow_ms = 10000;  ///< too many bus-offs within this time are permanent
constexpr int kBusOffLimit = 5;

constexpr uint8_t kLife_ms = 20;  ///< lifetime of a cyclic frame in the port's queue; older ones are stale
constexpr uint8_t kEventLife_ms = 100;  ///< lifetime of all other frames

}  // namespace whisker::can
