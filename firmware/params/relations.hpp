/// Relations between parameters. A new relation needs an entry in ParamFault, a line in for_each_relation
/// (with its own function if it takes more than a line), a name in params.cpp and a sentence for users in
/// host/scenario/params_text.cpp.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "firmware/params/reach.hpp"

namespace whisker {
namespace relations {

// Walls at right angles, one body radius away: 15 degrees beyond the rim of the cone, each is farther by 3.5
// %.
constexpr Angle kWidestCone = 60_deg;
constexpr Speed kWireSpeed = Speed::from_raw(100);  // the smallest speed that hal::WheelSpeeds can represent

/// Scope: void, or a type local to one source, which then gets its own, smaller copy.
template <class Scope>
struct Ranges {
  bool hold = true;
  template <class Tag>
  constexpr void number(const char*, const Unit<Tag>& x, Unit<Tag> low, Unit<Tag> high) noexcept {
    hold = hold && low <= x && x <= high;
  }
  constexpr void number(const char*, const Angle& x, Angle low, Angle high) noexcept {
    hold = hold && low.raw() <= x.raw() && x.raw() <= high.raw();
  }
  constexpr void count(const char*, const int32_t& x, int32_t low, int32_t high) noexcept {
    hold = hold && low <= x && x <= high;
  }
  template <class E>
  constexpr void choice(const char*, const E& x, const char* const*, int names) noexcept {
    hold = hold && static_cast<int>(x) < names;
  }
};

template <class Scope>
constexpr bool in_range(const Params& p) noexcept {
  Ranges<Scope> ranges;
  for_each_param(p, ranges);
  return ranges.hold;
}

/// v^2 / 2a + v (lag + longest gap): the stopping distance from full speed.
[[gnu::always_inline]] constexpr Length stopping_distance(const Params& p) noexcept {
  const int64_t v = p.wheels.max_speed.raw();
  const int64_t braking = divide_rounded(v * v, 2 * int64_t{p.wheels.max_acceleration.raw()});
  return Length::from_raw(saturate32(braking)) + p.wheels.max_speed * (p.wheels.motor_lag + longest_gap(p));
}

/// Twice the time from a command to the first count, and from one count to the next, both at the top speed of
/// a turn and near the end of a manoeuvre at a tolerance (at least one count) per `settle`; plus the time in
/// which the motor lag brings full speed below one count, with the ticks in which counts must stand still.
[[gnu::always_inline]] constexpr Duration slowest_count(const Params& p, Length count) noexcept {
  const int64_t square_ms2 = int64_t{count.raw()} * 2 * 1000000 / p.wheels.max_acceleration.raw();
  const uint32_t starting_ms = square_root(static_cast<uint64_t>(square_ms2));
  const Speed turning = min(p.wheels.max_speed, p.wheels.max_turn_rate * (p.body.track / 2));
  const Duration rolling = milliseconds(multiply_divide(count.raw(), 1000, turning.raw()));
  return (p.motion.settle + rolling + milliseconds(static_cast<int32_t>(starting_ms))) * 2 +
         p.wheels.motor_lag * 16 + p.safety.period * 6;
}

[[gnu::always_inline]] constexpr bool patch_holds_ways(const Params& p) noexcept {
  const Reach ways = reach(p);
  return patch_cell(p) * kHalfWindow >= ways.planning + cell_cover(p) + ways.probe &&
         ways.probe >= p.body.radius / 2;
}

}  // namespace relations

/// Calls visit(ParamFault, holds) for each relation while it returns true. Every relation needs values within
/// their own ranges: if out_of_range does not hold, it is the only one visited.
template <class Scope = void, class Visit>
[[gnu::always_inline]] constexpr void for_each_relation(const Params& p, Visit&& visit) noexcept {
  using F = ParamFault;
  namespace r = relations;
  const bool ranged = r::in_range<Scope>(p);
  if (!visit(F::out_of_range, ranged) || !ranged) return;

  const Duration between_readings = milliseconds(1000 / p.rangefinders.rate_hz) + p.rangefinders.latency;
  const Length count = millimetres(1000) / p.wheels.counts_per_metre;
  const Length turn_way = arc(p.motion.turn_tolerance, p.body.track / 2);
  const Length swept = p.thesis.base_step * 2 + p.body.radius + p.body.margin;
  const uint32_t outer_edge = p.rangefinders.side_angle.raw() + p.rangefinders.cone.raw() / 2;
  static_cast<void>(
      visit(F::track_wider_than_body, p.body.track <= p.body.radius * 2) &&
      visit(F::ranges_reversed, p.rangefinders.min_range < p.rangefinders.max_range) &&
      visit(F::cones_apart_from_front, outer_edge <= (90_deg).raw()) &&
      visit(F::danger_inside_body, p.thesis.danger_range > p.body.radius + p.body.margin) &&
      visit(F::steps_reversed, p.thesis.small_step <= p.thesis.base_step) &&
      visit(F::stop_longer_than_range, r::stopping_distance(p) <= p.rangefinders.max_range / 4) &&
      visit(F::stale_before_next_reading, p.conditioning.stale_after > between_readings) &&
      visit(F::lost_before_stale, p.safety.lost_after >= p.conditioning.stale_after) &&
      visit(F::tolerance_below_encoder, p.motion.drive_tolerance >= count && turn_way >= count) &&
      visit(F::gap_below_period, longest_gap(p) >= p.safety.period * 2) &&
      visit(F::stuck_within_cone, p.conditioning.stuck_turn.raw() > p.rangefinders.cone.raw()) &&
      visit(F::cone_too_wide, p.rangefinders.cone.raw() <= r::kWidestCone.raw()) &&
      visit(F::tolerance_above_step, p.motion.drive_tolerance < p.thesis.small_step &&
                                         p.motion.turn_tolerance.raw() < p.thesis.delta.raw()) &&
      visit(F::tolerance_below_wire, turn_way >= r::kWireSpeed * p.motion.settle) &&
      visit(F::stalled_before_count, p.safety.stalled_after >= r::slowest_count(p, count)) &&
      visit(F::settle_below_lag, p.motion.settle >= p.wheels.motor_lag + p.safety.period) &&
      visit(F::step_beyond_range, proving_range(p.rangefinders) >= swept) &&
      visit(F::cone_too_narrow, blind_reach(p) + patch_cell(p) <= p.body.radius * 7 / 4) &&
      visit(F::patch_too_small, r::patch_holds_ways(p)) &&
      visit(F::planning_below_shield, p.skirt.planning_margin >= p.skirt.shield_margin));
}

namespace formula {

struct FirstFault {
  ParamFault found = ParamFault::none;
  [[gnu::always_inline]] constexpr bool operator()(ParamFault fault, bool holds) noexcept {
    if (!holds) found = fault;
    return holds;
  }
};

template <class Scope>
[[gnu::always_inline]] constexpr ParamFault check(const Params& p) noexcept {
  FirstFault first;
  for_each_relation<Scope>(p, first);
  return first.found;
}

}  // namespace formula

namespace at_run_time {
ParamFault check(const Params& p) noexcept;
}  // namespace at_run_time

[[gnu::always_inline]] constexpr ParamFault check(const Params& p) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::check<void>(p);
  return at_run_time::check(p);
}

}  // namespace whisker
