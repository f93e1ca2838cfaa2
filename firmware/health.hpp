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
  drive_refused,   ///< the drive refused too many commands or reads of the counts, close to one another
  encoder_jump,    ///< the counts moved further than the wheels can
  wheels_stalled,  ///< commanded to move, and the counts of one wheel or of both stand still
  range_unsteady,  ///< it stood and looked for too long: a beam's readings come, and never agree
  no_progress,  ///< a turn or step comes no nearer to its end, or the robot stays in one place for too long
  pose_out_of_range,  ///< the body left kBodyLimit, or was placed beyond kPlaceLimit (core/region.hpp)
  wheel_runaway,      ///< a wheel turns much further than it was commanded, or backwards
};
constexpr int kFaults = 11;

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
  uint32_t wheel_runaways = 0;
  uint32_t unsteady_looks = 0;
  uint32_t no_progress = 0;
  uint32_t pose_out_of_range = 0;  ///< times the body left the region, and placements outside
  uint32_t late_ticks = 0;         ///< ticks more than a quarter of a period late
  uint32_t clock_jumps = 0;
};

constexpr void count(uint32_t& counter) noexcept {
  if (counter != UINT32_MAX) ++counter;
}

}  // namespace whisker
