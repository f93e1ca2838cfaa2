#include "firmware/params.hpp"

namespace whisker {

namespace {
struct OfThisSource;
}

namespace at_run_time {

Length patch_cell(const Params& p) noexcept { return formula::patch_cell(p); }
Length blind_reach(const Params& p) noexcept { return formula::blind_reach(p); }
Length cell_cover(const Params& p) noexcept { return formula::cell_cover(p); }
Reach reach(const Params& p) noexcept { return formula::reach(p); }
ParamFault check(const Params& p) noexcept { return formula::check<OfThisSource>(p); }

}  // namespace at_run_time

Length for_body(const Params& p, Length reference) noexcept {
  return Length::from_raw(multiply_divide(reference.raw(), p.body.radius.raw(), 90000));
}

const char* name(ParamFault fault) noexcept {
  switch (fault) {
    case ParamFault::none: return "none";
    case ParamFault::out_of_range: return "out_of_range";
    case ParamFault::track_wider_than_body: return "track_wider_than_body";
    case ParamFault::ranges_reversed: return "ranges_reversed";
    case ParamFault::cones_apart_from_front: return "cones_apart_from_front";
    case ParamFault::danger_inside_body: return "danger_inside_body";
    case ParamFault::steps_reversed: return "steps_reversed";
    case ParamFault::stop_longer_than_range: return "stop_longer_than_range";
    case ParamFault::stale_before_next_reading: return "stale_before_next_reading";
    case ParamFault::lost_before_stale: return "lost_before_stale";
    case ParamFault::tolerance_below_encoder: return "tolerance_below_encoder";
    case ParamFault::gap_below_period: return "gap_below_period";
    case ParamFault::stuck_within_cone: return "stuck_within_cone";
    case ParamFault::cone_too_wide: return "cone_too_wide";
    case ParamFault::tolerance_above_step: return "tolerance_above_step";
    case ParamFault::tolerance_below_wire: return "tolerance_below_wire";
    case ParamFault::stalled_before_count: return "stalled_before_count";
    case ParamFault::settle_below_lag: return "settle_below_lag";
    case ParamFault::cone_too_narrow: return "cone_too_narrow";
    case ParamFault::patch_too_small: return "patch_too_small";
    case ParamFault::planning_below_shield: return "planning_below_shield";
    case ParamFault::step_beyond_range: return "step_beyond_range";
  }
  return "?";
}

}  // namespace whisker
