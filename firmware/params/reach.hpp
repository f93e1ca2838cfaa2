/// Values derived from the parameters: the mounts of the beams, the cell of the local grid, and the reach of
/// the beams and of the grid. At run time these functions call params.cpp.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "firmware/params/derived.hpp"

namespace whisker {
namespace at_run_time {
Mount mount(const RangefinderParams& r, int beam) noexcept;
RimSweep rim_sweep(const Params& p) noexcept;
Reach reach(const Params& p) noexcept;
}  // namespace at_run_time

/// The shortest way from the first echo of an obstacle to its rim, if clear ground may hold it.
///
/// A disc as large as the body touches its flank. The outermost ray, at the angle A + cone / 2, gives an echo
/// once it meets the disc at the incidence L: radius x sin(L) / sin(A + cone / 2) before the contact on a
/// straight course. Two thirds of that is the shortest warning, because a smaller or a curved obstacle leaves
/// less.
Length shortest_warning(const Params& p) noexcept;

constexpr Length grid_cell(const Params& p) noexcept { return p.body.radius * 2 / 9; }
constexpr Length cell_cover(const Params& p) noexcept { return grid_cell(p) * kCellCover / 256; }
constexpr Length guard_slack(const Params& p) noexcept { return p.body.radius / 56; }

namespace formula {

[[gnu::always_inline]] constexpr Mount mount(const RangefinderParams& r, int beam) noexcept {
  const BeamParams& own = r.beams[beam];
  Mount m{};
  m.axis = beam_axis(r, beam);
  m.half_cone = Angle::from_raw(beam_cone(r, beam).raw() / 2);
  m.apex = {own.x, own.y};
  if (m.apex == Vec{} && r.offset != Length{}) m.apex = whisker::polar(m.axis, r.offset);
  return m;
}

/// Difference of the true and the estimated place between two readings.
constexpr Length place_error(const Params& p) noexcept {
  return micrometres(300) + millimetres(500) / p.wheels.counts_per_metre;
}

/// How far an edge of the cone passes from the centre, on its outer side.
constexpr Length edge_offset(const Mount& m) noexcept {
  return max(across(m.apex, m.axis + m.half_cone), -across(m.apex, m.axis - m.half_cone));
}

/// The turn on the spot in which each wheel counts once: the estimate of a turn may be that much too large.
constexpr Angle turn_of_counts(const Params& p) noexcept {
  return angle_of(millimetres(2000) / p.wheels.counts_per_metre, p.body.track);
}

/// The slowest acceptable sweep: a cone overlaps the next, and the turn is at least twice its error.
constexpr Angle slowest_step(Angle half_cone, Angle error) noexcept {
  constexpr Angle kSlowest = 3_deg;
  const uint32_t slowest = half_cone.raw() < kSlowest.raw() ? half_cone.raw() : kSlowest.raw();
  return Angle::from_raw(slowest > error.raw() * 2 ? slowest : error.raw() * 2);
}

[[gnu::always_inline]] constexpr RimSweep rim_sweep(const Params& p) noexcept {
  RimSweep sweep{false, p.body.radius, Angle::from_raw(UINT32_MAX), {}};
  const Length error = place_error(p);
  const Angle turn_error = turn_of_counts(p);
  Angle widest;
  for (int i = 0; i < 3; ++i) {
    const Mount m = whisker::mount(p.rangefinders, i);
    constexpr Angle kNarrowest = Angle::turns(1, 720);  // half of the least shared cone
    if (m.half_cone.raw() < kNarrowest.raw()) {
      sweep.needed = true;
      sweep.radius = Length::from_raw(INT32_MAX);
      continue;
    }
    if (m.half_cone.raw() > widest.raw()) widest = m.half_cone;
    const Q30 sine = whisker::sin(m.half_cone);
    const int64_t holds = quotient(int64_t{whisker::cell_cover(p).raw()} * Q30::kOne, sine.raw());
    sweep.needed = sweep.needed || whisker::norm(m.apex) + Length::from_raw(saturate32(holds)) >
                                       p.body.radius - whisker::cell_cover(p);
    const Length edge = max(Length{}, edge_offset(m)) + error;
    const Length room = p.body.radius - error;
    const Angle inner = edge < room ? arc_sine(edge, room) : 90_deg;
    const Angle most = Angle::from_raw(m.half_cone.raw() / 2 * 3);
    const Angle slowest = slowest_step(m.half_cone, turn_error);
    Angle step = slowest;
    if (slowest.raw() > most.raw()) {
      sweep.radius = Length::from_raw(INT32_MAX);
    } else if (inner.raw() + slowest.raw() / 2 <= m.half_cone.raw()) {
      step = (m.half_cone - inner) * 2;
      if (step.raw() > most.raw()) step = most;
    } else {
      const Q30 narrow = whisker::sin(m.half_cone - Angle::from_raw(slowest.raw() / 2));
      const int64_t radius = quotient(int64_t{edge.raw()} * Q30::kOne, narrow.raw());
      sweep.radius = max(sweep.radius, Length::from_raw(saturate32(radius)) + error);
    }
    if (step.raw() < sweep.step.raw()) sweep.step = step;
  }
  if (!sweep.needed) {
    sweep.radius = p.body.radius;
  } else {
    sweep.past = widest + arc_sine(whisker::cell_cover(p), sweep.radius) + 2_deg;
  }
  return sweep;
}

[[gnu::always_inline]] constexpr Reach reach(const Params& p) noexcept {
  const RimSweep sweep = whisker::rim_sweep(p);
  const Length swept = sweep.radius;
  const Length planning = swept + derived::planning_margin(p);
  const Length window = whisker::grid_cell(p) * kHalfWindow - whisker::cell_cover(p);
  Length probe = min(p.body.radius * 5 / 3, window - planning);
  if (loses_walls(p.rangefinders)) {
    probe = min(probe, kScatterRange + whisker::mount(p.rangefinders, 1).apex.x - planning);
  }
  return {swept + max(p.boundary.guard_margin, guard_slack(p)), planning, probe, sweep.past};
}

}  // namespace formula

[[gnu::always_inline]] constexpr Mount mount(const RangefinderParams& r, int beam) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::mount(r, beam);
  return at_run_time::mount(r, beam);
}
[[gnu::always_inline]] constexpr RimSweep rim_sweep(const Params& p) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::rim_sweep(p);
  return at_run_time::rim_sweep(p);
}
[[gnu::always_inline]] constexpr Reach reach(const Params& p) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::reach(p);
  return at_run_time::reach(p);
}

constexpr AngularRate turn_rate(const Params& p) noexcept {
  const RimSweep sweep = rim_sweep(p);
  if (!sweep.needed) return p.wheels.max_turn_rate;
  // Two readings make a step; a fifth is left for the wheels' unevenness, or more for coarse encoders.
  constexpr int64_t kMicroradians = 6283185;
  const uint32_t fifth = sweep.step.raw() / 5, error = formula::turn_of_counts(p).raw();
  const int64_t left = sweep.step.raw() - (error > fifth ? error : fifth);
  const int64_t step = scale_down<32>(left * kMicroradians);
  // Of several readings in a control period, only the newest counts. So from one such reading to the next but
  // one, as many intervals pass as begin in two periods.
  const int32_t begun = (2 * p.safety.period.raw() * p.rangefinders.rate_hz + 999) / 1000;
  const int32_t intervals = begun > 2 ? begun : 2;
  return min(p.wheels.max_turn_rate,
             AngularRate::from_raw(saturate32(quotient(step * p.rangefinders.rate_hz, intervals))));
}

}  // namespace whisker
