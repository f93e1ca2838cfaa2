/// The protocol's times, ms. A node that is polled every millisecond keeps each of them within one more.
#pragma once

#include <stdint.h>

namespace whisker::can {

constexpr uint32_t kHoldAfter_ms = 30;        ///< a beam's range is missing: brake, go on when it comes back
constexpr uint32_t kRangeLatch_ms = 100;      ///< it is still missing: safe stop
constexpr uint32_t kOdometryLate_ms = 50;     ///< no counts, or no complete input set: safe stop
constexpr uint32_t kCommandLate_ms = 49;      ///< no command: safe stop at the 50th
constexpr uint32_t kCommandOld_ms = 50;       ///< a command for measurements of before then is none
constexpr uint32_t kPeerLost_ms = 300;        ///< no heartbeat: safe stop
constexpr uint32_t kHeartbeat_ms = 100;       ///< between two of the own
constexpr uint32_t kFaultRepeat_ms = 1000;    ///< between two Fault frames while an error stands
constexpr uint32_t kDiagnostics_ms = 500;     ///< between two Diagnostics frames
constexpr uint32_t kStopRepeat_ms = 10;       ///< between two commands to stop
constexpr uint32_t kOrderRepeat_ms = 50;      ///< an order that is not answered is sent again
constexpr uint32_t kRestartAfter_ms = 100;    ///< of a port that left the bus
constexpr uint32_t kBusOffWindow_ms = 10000;  ///< so many bus-offs within this time, and it stays away
constexpr int kBusOffLimit = 5;

constexpr uint8_t kLife_ms = 20;        ///< of a cyclic frame in the port's queue: older ones are stale
constexpr uint8_t kEventLife_ms = 100;  ///< of all others

}  // namespace whisker::can
