/// Values derived from the parameters: the cell of the local grid, and the reach of the beams and the local
/// grid. At run time these functions call params.cpp.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"

namespace whisker {
namespace at_run_time {
Length patch_cell(const Params& p) noexcept;
Length blind_reach(const Params& p) noexcept;
Length cell_cover(const Params& p) noexcept;
Reach reach(const Params& p) noexcept;
}  // namespace at_run_time

namespace formula {

constexpr Q30 half_cone_sine(const Params& p) noexcept {
  return whisker::sin(Angle::from_raw(p.rangefinders.cone.raw() / 2));
}

[[gnu::always_inline]] constexpr Length patch_cell(const Params& p) noexcept {
  if (p.skirt.cell != Length{}) return p.skirt.cell;
  const Q30 s = half_cone_sine(p);
  const Length room = p.body.radius - p.rangefinders.offset;
  const int64_t cover = int64_t{room.raw()} * s.raw() / (int64_t{Q30::kOne} + s.raw());
  const Length provable = Length::from_raw(saturate32(cover * 256 / (kCellCover + 1)));
  return max(p.body.radius / 9, min(p.body.radius * 2 / 9, provable));
}

[[gnu::always_inline]] constexpr Length blind_reach(const Params& p) noexcept {
  const int64_t reach = int64_t{whisker::cell_cover(p).raw()} * Q30::kOne / half_cone_sine(p).raw();
  return p.rangefinders.offset + Length::from_raw(saturate32(reach));
}

[[gnu::always_inline]] constexpr Length cell_cover(const Params& p) noexcept {
  return whisker::patch_cell(p) * kCellCover / 256;
}

[[gnu::always_inline]] constexpr Reach reach(const Params& p) noexcept {
  const Length planning = p.body.radius + p.skirt.planning_margin;
  const bool given = p.skirt.probe != Length{};
  const Length within =
      min(p.body.radius * 5 / 3, whisker::patch_cell(p) * kHalfWindow - whisker::cell_cover(p) - planning);
  return {p.body.radius + p.skirt.shield_margin, planning, given ? p.skirt.probe : within};
}

}  // namespace formula

[[gnu::always_inline]] constexpr Length patch_cell(const Params& p) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::patch_cell(p);
  return at_run_time::patch_cell(p);
}
[[gnu::always_inline]] constexpr Length blind_reach(const Params& p) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::blind_reach(p);
  return at_run_time::blind_reach(p);
}
[[gnu::always_inline]] constexpr Length cell_cover(const Params& p) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::cell_cover(p);
  return at_run_time::cell_cover(p);
}
[[gnu::always_inline]] constexpr Reach reach(const Params& p) noexcept {
  if (__builtin_is_constant_evaluated()) return formula::reach(p);
  return at_run_time::reach(p);
}

}  // namespace whisker
