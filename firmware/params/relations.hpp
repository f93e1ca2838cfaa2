/// Relations between parameters. A new relation needs an entry in ParamFault, its name and its sentence in
/// relation(), and a line in for_each_relation (with its own function if it takes more than a line).
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "firmware/params/reach.hpp"
#include "firmware/part.hpp"

namespace whisker {

/// The relations between parameters; each comment states the condition. The numbers are those on the bus: a
/// missing one belonged to a parameter that is derived now, and stays free.
enum class ParamFault : uint8_t {
  none = 0,
  out_of_range = 1,               ///< a value lies outside its own range
  track_wider_than_body = 2,      ///< track <= 2 radius
  ranges_reversed = 3,            ///< min_range < max_range
  cones_apart_from_front = 4,     ///< each beam: angle of the axis + cone / 2 <= 90 degrees
  stop_longer_than_range = 7,     ///< stopping distance from full speed <= max_range / 4
  stale_before_next_reading = 8,  ///< stale_after > 1 / rate + latency
  gap_below_period = 11,          ///< max_gap, unless zero, >= 2 period
  cone_too_wide = 13,             ///< cone <= 60 degrees: square rooms do not look round
  tolerance_above_step = 14,  ///< drive_tolerance() < small_step(), turn_tolerance() < kDelta: derived.hpp
  stalled_before_count = 16,  ///< derived::slowest_count() <= kMostStalledAfter
  cone_too_narrow = 18,       ///< radius of rim_sweep() <= 7/4 radius
  local_grid_too_small = 19,  ///< the checked path, Reach::probe, >= radius / 2
  step_beyond_range = 21,     ///< derived::base_step() >= kShortestStep: no step is longer than the beams see
  beams_crossed = 22,         ///< the axes point from left to right
  creep_without_bumper = 23,  ///< creep_speed is zero unless a bumper is fitted
  gyro_unfit = 24,            ///< a fitted gyro: kGyroBuilt, range >= 5/4 max_turn_rate
  walls_without_bound = 25,   ///< straight walls need kGyroBuilt and a bound of the pose: PoseErrorParams
  walls_unseen =
      26,  ///< incidence below 90 degrees: each wall ahead lies within cone / 2 + incidence of a beam
  flank_unseen = 27,  ///< incidence below 90 degrees: see flank_is_seen() in this file
  blind_at_rim =
      28,  ///< incidence below 90 degrees: no minimum range ends beyond planning reach + radius / 2
};
constexpr int kParamFaults = static_cast<int>(ParamFault::blind_at_rim) + 1;  ///< with the missing numbers

struct Relation {
  const char* name;
  const char* words;  ///< the relation as a sentence for users; empty for none and for missing numbers
};
constexpr Relation relation(ParamFault fault) noexcept {
  using F = ParamFault;
  switch (fault) {
    case F::none: return {"none", ""};
    case F::out_of_range: return {"out_of_range", "a parameter lies outside its own range"};
    case F::track_wider_than_body:
      return {"track_wider_than_body",
              "the wheels must lie within the body: wheel_track_m <= 2 body_radius_m"};
    case F::ranges_reversed: return {"ranges_reversed", "range_min_m must be less than range_max_m"};
    case F::cones_apart_from_front:
      return {
          "cones_apart_from_front",
          "the beams must look ahead: range_side_angle_deg + range_cone_deg / 2 <= 90; the same holds for a "
          "beam's own range_left_angle_deg, range_left_cone_deg, range_front_angle_deg, "
          "range_front_cone_deg, range_right_angle_deg, range_right_cone_deg"};
    case F::stop_longer_than_range:
      return {"stop_longer_than_range",
              "the stopping distance from wheel_speed_max_mps, with wheel_acceleration_max_mps2, motor_lag_s "
              "and the longest gap between two ticks (max_tick_gap_s or, if 0, control_period_s + 0.05 s), "
              "must not exceed range_max_m / 4"};
    case F::stale_before_next_reading:
      return {"stale_before_next_reading",
              "stale_after_s must be greater than 1 / range_rate_hz + range_latency_s"};
    case F::gap_below_period:
      return {
          "gap_below_period",
          "max_tick_gap_s must be at least 2 control_period_s, over CAN also control_period_s + 0.049, or 0"};
    case F::cone_too_wide: return {"cone_too_wide", "range_cone_deg must not be greater than 60"};
    case F::tolerance_above_step:
      return {
          "tolerance_above_step",
          "1 / encoder_counts_per_m must be less than the thesis planner's small step (0.1 m, or less for "
          "short range_max_m or range_clear_m), and at the rim (wheel_track_m / 2) less than 10 degrees"};
    case F::stalled_before_count:
      return {
          "stalled_before_count",
          "the wheels must count soon: 16 motor_lag_s + 6 control_period_s + twice the time in which it "
          "settles (0.08 s, or motor_lag_s + control_period_s if longer) + twice the time in which a wheel "
          "covers 1 / encoder_counts_per_m from rest (wheel_acceleration_max_mps2) and again at full turn "
          "rate (turn_rate_max_radps, wheel_track_m, wheel_speed_max_mps) must not exceed 10 s"};
    case F::cone_too_narrow:
      return {
          "cone_too_narrow",
          "the beams must be able to clear the ground near the body: beyond 7/4 body_radius_m, a turn on the "
          "spot must leave no gap between the cones of readings one after another; it does with a smaller "
          "range_offset_m, a larger range_cone_deg or more encoder_counts_per_m"};
    case F::local_grid_too_small:
      return {
          "local_grid_too_small",
          "the beams must see half of body_radius_m ahead of the body: if range_incidence_deg is below 90, "
          "the path is checked up to 0.5 m ahead of the front beam (range_front_x_m or range_offset_m); nor "
          "may "
          "skirt_shield_margin_m leave less of the local grid"};
    case F::step_beyond_range:
      return {"step_beyond_range",
              "range_clear_m and range_max_m must not be less than 0.04 + body_radius_m + body_margin_m"};
    case F::beams_crossed:
      return {"beams_crossed",
              "range_left_angle_deg must be greater than range_front_angle_deg, and that greater than "
              "range_right_angle_deg"};
    case F::creep_without_bumper:
      return {"creep_without_bumper", "creep_speed_mps must be 0 unless bumper is true"};
    case F::gyro_unfit:
      return {"gyro_unfit",
              "gyro_range_radps must not be less than 5/4 turn_rate_max_radps unless gyro is false, which it "
              "must be in an image without the code for a gyro"};
    case F::walls_without_bound:
      return {"walls_without_bound",
              "straight_walls must be false unless wheel_scale_sigma, wheel_scale_common_sigma or "
              "heading_drift_deg_per_sqrt_m is greater than 0, and in an image without the code for a gyro"};
    case F::walls_unseen:
      return {
          "walls_unseen",
          "some beam must see each wall ahead: if range_incidence_deg is below 90, every direction from "
          "-90 to 90 degrees must lie within range_incidence_deg + range_cone_deg / 2 of the axis of a beam "
          "(range_side_angle_deg; range_left_angle_deg, range_front_angle_deg, range_right_angle_deg)"};
    case F::flank_unseen:
      return {
          "flank_unseen",
          "the cones must see ends of walls before the flank meets them: if range_incidence_deg is below 90, "
          "on either side some cone must cover, at most 0.5 m from its apex and at least the stopping "
          "distance (wheel_speed_max_mps, at most 5/3 body_radius_m) ahead, the line body_radius_m beside "
          "the course (range_side_angle_deg, range_cone_deg; range_left_angle_deg, range_right_angle_deg)"};
    case F::blind_at_rim:
      return {"blind_at_rim",
              "the sensors must measure what stands near the rim: if range_incidence_deg is below 90, "
              "range_min_m and the distance of the apex along its beam (range_offset_m) must not exceed 3/2 "
              "body_radius_m + 0.002 + skirt_shield_margin_m"};
  }
  return {"?", ""};
}

namespace at_run_time {
bool in_range(const Params& p) noexcept;
ParamFault check(const Params& p) noexcept;
}  // namespace at_run_time

namespace relations {

// Walls at right angles, one body radius away: 15 degrees beyond the rim of the cone, each is 3.5 %
// farther.
constexpr Angle kWidestCone = 60_deg;

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
    hold = hold && 0 <= static_cast<int>(x) && static_cast<int>(x) < names;
  }
  constexpr void derived(const char*) noexcept {}
};

[[gnu::always_inline]] constexpr bool in_range(const Params& p) noexcept {
  if (!__builtin_is_constant_evaluated()) return at_run_time::in_range(p);
  Ranges ranges;
  for_each_param(p, ranges);
  return ranges.hold;
}

/// What relations need to know of the three beams together.
struct Beams {
  bool ordered = true;     ///< the axes point from left to right
  uint32_t outermost = 0;  ///< direction of an edge from straight ahead
  uint32_t widest = 0;     ///< cone
};
constexpr Beams beams(const RangefinderParams& r) noexcept {
  Beams all;
  int32_t left_of_it = INT32_MAX;
  for (int i = 0; i < 3; ++i) {
    const Mount m = mount(r, i);
    const uint32_t edge = magnitude(m.axis) + m.half_cone.raw();
    all.ordered = all.ordered && m.axis.wrapped() < left_of_it;
    all.outermost = edge > all.outermost ? edge : all.outermost;
    all.widest = beam_cone(r, i).raw() > all.widest ? beam_cone(r, i).raw() : all.widest;
    left_of_it = m.axis.wrapped();
  }
  return all;
}

/// v^2 / 2a + v (lag + longest gap): the stopping distance from full speed.
[[gnu::always_inline]] constexpr Length stopping_distance(const Params& p) noexcept {
  const int64_t v = p.wheels.max_speed.raw();
  const int64_t braking = divide_rounded(v * v, (p.wheels.max_acceleration * 2).raw());
  return Length::from_raw(saturate32(braking)) + p.wheels.max_speed * (p.wheels.motor_lag + longest_gap(p));
}

[[gnu::always_inline]] constexpr bool beams_clear_the_rim(const Params& p) noexcept {
  return rim_sweep(p).radius <= p.body.radius * 7 / 4;
}

[[gnu::always_inline]] constexpr bool sees_ways(const Params& p) noexcept {
  return reach(p).probe >= p.body.radius / 2;
}

/// A wall gives an echo to a beam in whose cone a ray meets it within the incidence of its normal.
constexpr bool walls_are_seen(const RangefinderParams& r) noexcept {
  if (!loses_walls(r)) return true;
  constexpr int64_t kAbeam = INT64_C(1) << 30;
  int64_t seen_to = -kAbeam;  // normals from the right to the left
  for (int pass = 0; pass < 3; ++pass) {
    for (int i = 0; i < 3; ++i) {
      const int64_t half = int64_t{beam_cone(r, i).raw() / 2} + r.incidence.raw();
      const int64_t axis = beam_axis(r, i).wrapped();
      if (axis - half <= seen_to && axis + half > seen_to) seen_to = axis + half;
    }
  }
  return seen_to >= kAbeam;
}

/// Whether this beam sees an end of a wall on the line that the flank follows: within the local grid, while
/// it echoes, and while the body can still stop.
constexpr bool sees_flank(const Params& p, int beam, bool left) noexcept {
  const Mount m = mount(p.rangefinders, beam);
  const Reach ways = reach(p);
  const Length beside = ways.guard - (left ? m.apex.y : -m.apex.y);
  const Length range = min(proving_range(p.rangefinders), kScatterRange);
  if (beside <= Length{} || beside > range) return beside <= Length{};
  const int64_t axis = left ? m.axis.wrapped() : -int64_t{m.axis.wrapped()};
  const int64_t inner = axis - m.half_cone.raw(), outer = axis + m.half_cone.raw();
  const int64_t far = arc_sine(beside, range).wrapped();
  const int64_t first = inner > far ? inner : far;
  if (first > outer) return false;
  const auto ahead = [&](int64_t ray) {
    const Angle to = Angle::from_raw(static_cast<uint32_t>(ray));
    return m.apex.x + Length::from_raw(multiply_divide(beside.raw(), cos(to).raw(), sin(to).raw()));
  };
  return ahead(outer) <= grid_cell(p) * (kHalfWindow + 3) &&
         ahead(first) >= min(stopping_distance(p), ways.probe);
}

constexpr bool flank_is_seen(const Params& p) noexcept {
  if (!loses_walls(p.rangefinders)) return true;
  bool left = false, right = false;
  for (int i = 0; i < 3; ++i) {
    left = left || sees_flank(p, i, true);
    right = right || sees_flank(p, i, false);
  }
  return left && right;
}

constexpr bool rim_is_measured(const Params& p) noexcept {
  if (!loses_walls(p.rangefinders)) return true;
  const Length most = reach(p).planning + p.body.radius / 2;
  bool holds = true;
  for (int i = 0; i < 3; ++i) {
    const Mount m = mount(p.rangefinders, i);
    holds = holds && along(m.apex, m.axis) + p.rangefinders.min_range <= most;
  }
  return holds;
}

}  // namespace relations

/// Calls visit(ParamFault, holds) for each relation while it returns true. Every relation needs values within
/// their own ranges: if out_of_range does not hold, it is the only one visited.
template <class Visit>
[[gnu::always_inline]] constexpr void for_each_relation(const Params& p, Visit&& visit) noexcept {
  using F = ParamFault;
  namespace r = relations;
  const bool ranged = r::in_range(p);
  if (!visit(F::out_of_range, ranged) || !ranged) return;

  const Duration between_readings = milliseconds(1000 / p.rangefinders.rate_hz) + p.rangefinders.latency;
  const r::Beams beams = r::beams(p.rangefinders);
  static_cast<void>(
      visit(F::track_wider_than_body, p.body.track <= p.body.radius * 2) &&
      visit(F::ranges_reversed, p.rangefinders.min_range < p.rangefinders.max_range) &&
      visit(F::cones_apart_from_front, beams.outermost <= (90_deg).raw()) &&
      visit(F::stop_longer_than_range, r::stopping_distance(p) <= p.rangefinders.max_range / 4) &&
      visit(F::stale_before_next_reading, p.conditioning.stale_after > between_readings) &&
      visit(F::gap_below_period, longest_gap(p) >= p.safety.period * 2) &&
      visit(F::cone_too_wide, beams.widest <= r::kWidestCone.raw()) &&
      visit(F::step_beyond_range, derived::base_step(p) >= derived::kShortestStep) &&
      visit(F::tolerance_above_step, derived::drive_tolerance(p) < derived::small_step(p) &&
                                         derived::turn_tolerance(p).raw() < derived::kDelta.raw()) &&
      visit(F::stalled_before_count, derived::slowest_count(p) <= derived::kMostStalledAfter) &&
      visit(F::cone_too_narrow, r::beams_clear_the_rim(p)) &&
      visit(F::local_grid_too_small, r::sees_ways(p)) && visit(F::beams_crossed, beams.ordered) &&
      visit(F::creep_without_bumper, p.bumper.fitted == Fitted::yes || p.bumper.creep_speed == Speed{}) &&
      visit(F::gyro_unfit,
            p.gyro.fitted == Fitted::no || (kGyroBuilt && p.gyro.range >= p.wheels.max_turn_rate * 5 / 4)) &&
      visit(F::walls_without_bound,
            p.walls.straight == Fitted::no || (kGyroBuilt && declares_errors(p.pose_error))) &&
      visit(F::walls_unseen, r::walls_are_seen(p.rangefinders)) &&
      visit(F::flank_unseen, r::flank_is_seen(p)) && visit(F::blind_at_rim, r::rim_is_measured(p)));
}

namespace formula {

struct FirstFault {
  ParamFault found = ParamFault::none;
  [[gnu::always_inline]] constexpr bool operator()(ParamFault fault, bool holds) noexcept {
    if (!holds) found = fault;
    return holds;
  }
};

[[gnu::always_inline]] constexpr ParamFault check(const Params& p) noexcept {
  FirstFault first;
  for_each_relation(p, first);
  return first.found;
}

}  // namespace formula

[[gnu::always_inline]] constexpr ParamFault check(const Params& p) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::check(p);
  return at_run_time::check(p);
}

}  // namespace whisker
