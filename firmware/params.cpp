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

const char* name(ParamFault fault) noexcept { return relation(fault).name; }

}  // namespace whisker
