#include "firmware/params.hpp"

#include "firmware/params/relations.hpp"

namespace whisker {
namespace at_run_time {

Mount mount(const RangefinderParams& r, int beam) noexcept { return formula::mount(r, beam); }
RimSweep rim_sweep(const Params& p) noexcept { return formula::rim_sweep(p); }
Reach reach(const Params& p) noexcept { return formula::reach(p); }

}  // namespace at_run_time

Length shortest_warning(const Params& p) noexcept {
  const Q30 seen = sin(p.rangefinders.incidence);
  const Q30 edge = sin(Angle::from_raw(relations::beams(p.rangefinders).outermost));
  const int64_t way = quotient(int64_t{p.body.radius.raw()} * seen.raw(), edge.raw());
  return Length::from_raw(saturate32(way)) * 2 / 3;
}

Length for_body(const Params& p, Length reference) noexcept {
  constexpr uint32_t kReference = 90000, kEven = 4;
  // Divided by 2^kEven first, almost all products have 32 bits.
  const uint64_t whole = product(magnitude(reference.raw()), magnitude(p.body.radius.raw())) + kReference / 2;
  if (whole >> (32 + kEven) != 0) {
    return Length::from_raw(multiply_divide(reference.raw(), p.body.radius.raw(), kReference));
  }
  const auto part = static_cast<int32_t>(static_cast<uint32_t>(whole >> kEven) / (kReference >> kEven));
  return Length::from_raw(reference.raw() < 0 ? -part : part);
}

}  // namespace whisker
