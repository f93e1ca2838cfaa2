/// What the robot derives instead of asking for it: constants, and values that follow from the parameters.
// No #pragma once: params.hpp includes this file at its end, before the relations, whoever includes which
// first.
#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"

#ifndef WHISKER_PARAMS_DERIVED
#define WHISKER_PARAMS_DERIVED

namespace whisker::derived {

// Readings.
constexpr int32_t kConsensusReads = 3;         ///< that become one: see Consensus
constexpr Length kConsensusTolerance = 60_mm;  ///< of agreeing readings
constexpr Angle kStuckTurn = 150_deg;          ///< the same millimetre over this turn: suspected to be stuck
constexpr Duration kLeastLostAfter = 1000_ms;
/// A beam lost for this long is a fault.
constexpr Duration lost_after(const Params& p) noexcept {
  return max(kLeastLostAfter, p.conditioning.stale_after);
}
constexpr int32_t kMostRefusals = 5;  ///< of the drive or the bumper, close to one another

// The local grid.
/// Clearance for a chosen heading; more than the guard's.
constexpr Length planning_margin(const Params& p) noexcept { return p.boundary.guard_margin + 2_mm; }
constexpr Length kAgeTravel = 500_mm;        ///< clear cells expire after one to two of these distances
constexpr Angle kAgeTurn = 340_deg;          ///< or after one to two of these turns, whichever comes first
constexpr Speed kMoverSpeed = 300_mm_per_s;  ///< assumed speed of moving objects

// Movements.
/// Time constant of the approach to a stop.
constexpr Duration settle_time(const Params& p) noexcept {
  return max(80_ms, p.wheels.motor_lag + p.safety.period);
}
/// Rim travel per encoder count, rounded up.
constexpr Length encoder_count(const Params& p) noexcept {
  return micrometres((1000000 + p.wheels.counts_per_metre - 1) / p.wheels.counts_per_metre);
}
/// A drive ends within this distance of its end: 2 mm, at least an encoder count.
constexpr Length drive_tolerance(const Params& p) noexcept { return max(2_mm, encoder_count(p)); }
/// A turn ends within this angle of its end: 1 degree, at least an encoder count at the rim.
constexpr Angle turn_tolerance(const Params& p) noexcept {
  const Length count = encoder_count(p), rim = p.body.track / 2;
  if (arc(1_deg, rim) >= count) return 1_deg;
  return angle_of(count + micrometres(1), rim);
}

/// Twice the time from a command to the first count, and from one count to the next, both at the top speed of
/// a turn and near the end of a manoeuvre at a tolerance (at least one count) per `settle`; plus the time in
/// which the motor lag brings full speed below one count, with the ticks in which counts must stand still.
constexpr Duration slowest_count(const Params& p) noexcept {
  const Length count = encoder_count(p);
  const int64_t square_ms2 = quotient(int64_t{count.raw()} * 2 * 1000000, p.wheels.max_acceleration.raw());
  const uint32_t starting_ms = square_root(static_cast<uint64_t>(square_ms2));
  const Speed turning = min(p.wheels.max_speed, p.wheels.max_turn_rate * (p.body.track / 2));
  const Duration rolling = milliseconds(multiply_divide(count.raw(), 1000, turning.raw()));
  return (settle_time(p) + rolling + milliseconds(static_cast<int32_t>(starting_ms))) * 2 +
         p.wheels.motor_lag * 16 + p.safety.period * 6;
}

constexpr Duration kLeastStalledAfter = 2000_ms;
constexpr Duration kMostStalledAfter = 10000_ms;
/// Wheels without counts, or a manoeuvre without progress for this long: a fault.
constexpr Duration stalled_after(const Params& p) noexcept {
  return max(kLeastStalledAfter, slowest_count(p));
}
/// Longer than stalled_after(); costs a comparison while it is short.
constexpr bool outlasts_a_stall(Duration x, const Params& p) noexcept {
  return x > kLeastStalledAfter && x > stalled_after(p);
}

// The thesis planner.
constexpr Angle kBaseTurn = 30_deg;  ///< turn of the thesis planner's step at SA = 1
constexpr Angle kDelta = 10_deg;     ///< deflection between two probes
constexpr Length kLongestStep = 200_mm;
constexpr Length kShortestStep = 20_mm;
constexpr Length kLeastDanger = 300_mm;
/// The longest step: no step is longer than the beams see.
constexpr Length base_step(const Params& p) noexcept {
  return min(kLongestStep, (proving_range(p.rangefinders) - p.body.radius - p.body.margin) / 2);
}
constexpr Length small_step(const Params& p) noexcept { return base_step(p) / 2; }
/// The target direction is blocked below this.
constexpr Length danger_range(const Params& p) noexcept {
  return max(kLeastDanger, (p.body.radius + p.body.margin) * 5 / 2);
}
/// Visited positions, after which it gives up.
constexpr int32_t most_steps(const Params& p) noexcept {
  return p.boundary.length_budget.raw() / small_step(p).raw();
}

}  // namespace whisker::derived

#endif
