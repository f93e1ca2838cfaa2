/// Failures have names, and every one is counted.
#pragma once

#include <stdint.h>

namespace whisker {

/// Why the robot stands and will not move until reset(); the first one stays.
enum class Fault : uint8_t {
  none,
  invalid_params,  ///< check() refused the parameter set
  clock_jump,      ///< tick() was called with a time too far from the one before, or before it
  range_lost,      ///< a beam had no usable reading for too long
  drive_refused,   ///< the drive refused commands or gave no counts, several times in a row
  encoder_jump,    ///< the counts moved further than the wheels can
  wheels_stalled,  ///< commanded to move, and the counts stand still
  range_unsteady,  ///< it stood and looked for too long: a beam's readings come, and never agree
  no_progress,     ///< the wheels turn, and the turn or step comes no nearer to its end, or to its rest
};
constexpr int kFaults = 9;

const char* name(Fault fault) noexcept;

/// How often each failure happened since the start; the counters stop at their maximum.
struct Health {
  Fault fault = Fault::none;
  uint32_t range_refused = 0;       ///< the HAL had no readings at all at a tick
  uint32_t range_invalid = 0;       ///< readings that said so, or with an unknown status
  uint32_t range_stale = 0;         ///< times a beam went stale
  uint32_t range_stuck = 0;         ///< readings discarded because the sensor is stuck
  uint32_t range_out_of_range = 0;  ///< readings outside the sensor's own range
  uint32_t drive_refused = 0;       ///< commands that the drive refused
  uint32_t encoder_refused = 0;     ///< ticks without counts
  uint32_t encoder_jumps = 0;
  uint32_t wheel_stalls = 0;
  uint32_t unsteady_looks = 0;
  uint32_t no_progress = 0;
  uint32_t late_ticks = 0;  ///< ticks more than half a period late
  uint32_t clock_jumps = 0;
};

constexpr void count(uint32_t& counter) noexcept {
  if (counter != UINT32_MAX) ++counter;
}

}  // namespace whisker
