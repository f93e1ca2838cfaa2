/// Every failure has a name and a counter.
#pragma once

#include <stdint.h>

namespace whisker {

/// Why the robot stands until reset(); the first fault is latched.
enum class Fault : uint8_t {
  none,
  invalid_params,  ///< check() refused the parameter set
  clock_jump,      ///< the time of a tick is too far from that of the last one, or before it
  range_lost,      ///< a beam had no usable reading for too long
  drive_refused,   ///< the drive refused too many commands or reads of the counts within a short time
  encoder_jump,    ///< the counts moved further than the wheels can turn
  wheels_stalled,  ///< commanded to move, but the counts of one or both wheels stand still
  range_unsteady,  ///< a static scan waits too long: readings of a beam arrive but never agree
  no_progress,     ///< a turn or step comes no nearer to its end, or the robot presses a bump switch in one
                   ///< place again and again
  pose_out_of_range,  ///< the body left kBodyLimit, or was placed beyond kPlaceLimit (math/region.hpp)
  wheel_runaway,      ///< a wheel turns much further than commanded, or backwards
  bumper_lost,        ///< the bumper gave no state too often within a short time
  bumper_stuck,       ///< a bump switch stays pressed although the body has backed off
  range_untrusted,    ///< the readings contradict each other or the parameters: see RangeTrust
};
constexpr int kFaults = 14;

/// How far the rangefinders do what the parameters say.
enum class RangeLevel : uint8_t {
  trusted,
  doubtful,   ///< the robot drives slowly, and echoes take clear ground back
  untrusted,  ///< the robot stops with Fault::range_untrusted
};
constexpr int kRangeLevels = 3;

const char* name(Fault fault) noexcept;
const char* name(RangeLevel level) noexcept;

/// What the robot measures of its rangefinders; docs/safety.md has figures of good and bad sensors.
struct RangeTrust {
  static constexpr uint16_t kOnePerMetre = 256;
  RangeLevel level = RangeLevel::trusted;
  uint16_t contradictions = 0;  ///< echoes from ground shown empty, 1/256 per metre, over the last 4 m
  uint16_t phantoms = 0;        ///< share of empty readings with a single near echo, 2^-16, worst beam
  uint16_t false_clears = 0;    ///< share of single clear readings among echoes, 2^-16, worst beam
  uint8_t incidence_deg = 0;    ///< walls gave echoes up to this angle from their normal; 0: unknown
};

/// How often each failure happened since the start; the counters saturate.
struct Health {
  Fault fault = Fault::none;
  uint32_t range_refused = 0;       ///< ticks at which the HAL had no readings
  uint32_t range_invalid = 0;       ///< readings reported as invalid, or with an unknown status
  uint32_t range_stale = 0;         ///< number of times that a beam became stale
  uint32_t range_stuck = 0;         ///< readings discarded because the sensor is stuck
  uint32_t range_out_of_range = 0;  ///< readings outside the range of the sensor
  uint32_t drive_refused = 0;       ///< commands that the drive refused
  uint32_t encoder_refused = 0;     ///< ticks without counts
  uint32_t encoder_jumps = 0;
  uint32_t wheel_stalls = 0;
  uint32_t wheel_runaways = 0;
  uint32_t unsteady_looks = 0;
  uint32_t no_progress = 0;
  uint32_t pose_out_of_range = 0;  ///< number of times the body left the region, and placements outside it
  uint32_t late_ticks = 0;         ///< ticks more than a quarter of a period late
  uint32_t clock_jumps = 0;
  uint32_t bumps = 0;           ///< presses of a bump switch during a mission
  uint32_t bumper_refused = 0;  ///< ticks without the state of the bump switches
  uint32_t bumper_stuck = 0;
  uint32_t gyro_lost = 0;       ///< number of times that the gyro fell silent; the wheels then turn the pose
  uint32_t gyro_saturated = 0;  ///< ticks at which a sample was at the limit of its range
  uint32_t wheel_slips = 0;     ///< stretches on which the wheels disagree with the gyro
  uint32_t fix_jumps = 0;       ///< fixes that differ from the estimate by more than both sigmas allow
  uint32_t fixes_refused = 0;
  RangeTrust ranges;
};

constexpr void count(uint32_t& counter) noexcept {
  if (counter != UINT32_MAX) ++counter;
}

}  // namespace whisker
