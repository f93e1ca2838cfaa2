#include "firmware/params.hpp"

namespace whisker {
namespace at_run_time {

Mount mount(const RangefinderParams& r, int beam) noexcept { return formula::mount(r, beam); }
RimSweep rim_sweep(const Params& p) noexcept { return formula::rim_sweep(p); }
Reach reach(const Params& p) noexcept { return formula::reach(p); }

}  // namespace at_run_time

Length for_body(const Params& p, Length reference) noexcept {
  return Length::from_raw(multiply_divide(reference.raw(), p.body.radius.raw(), 90000));
}

}  // namespace whisker
