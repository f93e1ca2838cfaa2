#include "firmware/params.hpp"

#include "firmware/core/trig.hpp"

namespace whisker {
namespace {

constexpr Speed kWireSpeed = Speed::from_raw(100);  // the smallest that hal::WheelSpeeds can say

struct RangeCheck {
  bool ok = true;
  template <class Tag>
  void number(const char*, const Unit<Tag>& x, Unit<Tag> low, Unit<Tag> high) {
    ok = ok && low <= x && x <= high;
  }
  void number(const char*, const Angle& x, Angle low, Angle high) {
    ok = ok && low.raw() <= x.raw() && x.raw() <= high.raw();
  }
  void count(const char*, const int32_t& x, int32_t low, int32_t high) { ok = ok && low <= x && x <= high; }
  template <class E>
  void choice(const char*, const E& x, const char* const*, int names) {
    ok = ok && static_cast<int>(x) < names;
  }
};

/// v^2 / 2a + v (lag + one period): how far full speed carries the body after the order to stop.
Length stopping_distance(const Params& p) {
  const int64_t v = p.wheels.max_speed.raw();
  const int64_t braking = divide_rounded(v * v, 2 * int64_t{p.wheels.max_acceleration.raw()});
  return Length::from_raw(saturate32(braking)) + p.wheels.max_speed * (p.wheels.motor_lag + p.safety.period);
}

/// Twice what passes from the order to move to the first count, and from one count to the next, be it at the
/// turn's top speed or near a manoeuvre's end at a tolerance (at least one count) per `settle`; and what the
/// motor's lag needs to bring full speed below one count, with the ticks in which counts must stand still.
Duration slowest_count(const Params& p, Length count) {
  const int64_t square_ms2 = int64_t{count.raw()} * 2 * 1000000 / p.wheels.max_acceleration.raw();
  const uint32_t starting_ms = square_root(static_cast<uint64_t>(square_ms2));
  const Speed turning = min(p.wheels.max_speed, p.wheels.max_turn_rate * (p.body.track / 2));
  const Duration rolling = milliseconds(multiply_divide(count.raw(), 1000, turning.raw()));
  return (p.motion.settle + rolling + milliseconds(static_cast<int32_t>(starting_ms))) * 2 +
         p.wheels.motor_lag * 16 + p.safety.period * 6;
}

}  // namespace

namespace {

constexpr int32_t kHalfWindow = 15;  // cells
Q30 half_cone_sine(const Params& p) noexcept { return sin(Angle::from_raw(p.rangefinders.cone.raw() / 2)); }

}  // namespace

Length patch_cell(const Params& p) noexcept {
  if (p.skirt.cell != Length{}) return p.skirt.cell;
  const Q30 s = half_cone_sine(p);
  const Length room = p.body.radius - p.rangefinders.offset;
  const int64_t cover = int64_t{room.raw()} * s.raw() / (int64_t{Q30::kOne} + s.raw());
  const Length provable = Length::from_raw(saturate32(cover * 256 / (kCellCover + 1)));
  return max(p.body.radius / 9, min(p.body.radius * 2 / 9, provable));
}

Length blind_reach(const Params& p) noexcept {
  const int64_t reach = int64_t{cell_cover(p).raw()} * Q30::kOne / half_cone_sine(p).raw();
  return p.rangefinders.offset + Length::from_raw(saturate32(reach));
}

Length cell_cover(const Params& p) noexcept { return patch_cell(p) * kCellCover / 256; }

Reach reach(const Params& p) noexcept {
  const Length covered = p.body.radius + cell_cover(p);
  const Length planning = covered + p.skirt.planning_margin;
  const bool given = p.skirt.probe != Length{};
  const Length within = min(p.body.radius * 5 / 3, patch_cell(p) * kHalfWindow - planning);
  return {covered + p.skirt.shield_margin, planning, given ? p.skirt.probe : within};
}

ParamFault check(const Params& p) noexcept {
  RangeCheck ranges;
  for_each_param(p, ranges);
  if (!ranges.ok) return ParamFault::out_of_range;
  if (p.body.track > p.body.radius * 2) return ParamFault::track_wider_than_body;
  if (p.rangefinders.min_range >= p.rangefinders.max_range) return ParamFault::ranges_reversed;
  if (p.rangefinders.side_angle.raw() + p.rangefinders.cone.raw() / 2 > (90_deg).raw()) {
    return ParamFault::cones_apart_from_front;
  }
  if (p.thesis.danger_range <= p.body.radius + p.body.margin) return ParamFault::danger_inside_body;
  if (p.thesis.small_step > p.thesis.base_step) return ParamFault::steps_reversed;
  if (stopping_distance(p) > p.rangefinders.max_range / 4) return ParamFault::stop_longer_than_range;
  const Duration between = milliseconds(1000 / p.rangefinders.rate_hz) + p.rangefinders.latency;
  if (p.conditioning.stale_after <= between) return ParamFault::stale_before_next_reading;
  if (p.safety.lost_after < p.conditioning.stale_after) return ParamFault::lost_before_stale;
  const Length count = millimetres(1000) / p.wheels.counts_per_metre;
  const Length turn_way = arc(p.motion.turn_tolerance, p.body.track / 2);
  if (p.motion.drive_tolerance < count || turn_way < count) return ParamFault::tolerance_below_encoder;
  if (p.safety.max_gap < p.safety.period * 2) return ParamFault::gap_below_period;
  if (p.conditioning.stuck_turn.raw() <= p.rangefinders.cone.raw()) return ParamFault::stuck_within_cone;
  if (p.motion.drive_tolerance >= p.thesis.small_step ||
      p.motion.turn_tolerance.raw() >= p.thesis.delta.raw()) {
    return ParamFault::tolerance_above_step;
  }
  if (turn_way < kWireSpeed * p.motion.settle) return ParamFault::tolerance_below_wire;
  if (p.safety.stalled_after < slowest_count(p, count)) return ParamFault::stalled_before_count;
  if (p.motion.settle < p.wheels.motor_lag + p.safety.period) return ParamFault::settle_below_lag;
  const Length swept = p.thesis.base_step * 2 + p.body.radius + p.body.margin;
  if (p.rangefinders.max_range < swept) return ParamFault::step_beyond_range;
  if (blind_reach(p) + patch_cell(p) > p.body.radius * 7 / 4) return ParamFault::cone_too_narrow;
  const Reach ways = reach(p);
  if (patch_cell(p) * kHalfWindow < ways.planning + ways.probe || ways.probe < p.body.radius / 2) {
    return ParamFault::patch_too_small;
  }
  if (p.skirt.planning_margin < p.skirt.shield_margin) return ParamFault::planning_below_shield;
  return ParamFault::none;
}

}  // namespace whisker
