#include "firmware/safety/warning.hpp"

#include "firmware/math/trig.hpp"
#include "firmware/params/reach.hpp"

namespace whisker::safety {
namespace {

constexpr int32_t kReadings = 3;  // after the first one, until an echo counts

Angle outermost(const Params& params) noexcept {
  Angle most;
  for (int i = 0; i < 3; ++i) {
    const Mount m = mount(params.rangefinders, i);
    const Angle edge = Angle::from_raw(magnitude(m.axis)) + m.half_cone;
    if (edge.raw() > most.raw()) most = edge;
  }
  return most.raw() > (90_deg).raw() ? 90_deg : most;
}

}  // namespace

Length shortest_warning(const Params& params) noexcept {
  const Q30 seen = sin(params.rangefinders.incidence);
  const Q30 edge = sin(outermost(params));
  const int64_t way = int64_t{params.body.radius.raw()} * seen.raw() / edge.raw();
  return Length::from_raw(saturate32(way)) * 2 / 3;
}

Speed warned_speed(const Params& params) noexcept {
  const RangefinderParams& r = params.rangefinders;
  const Duration delay = r.latency + milliseconds(kReadings * 1000 / r.rate_hz) + params.motion.settle;
  const int64_t a = params.wheels.max_acceleration.raw();
  const int64_t lead = (params.wheels.max_acceleration * delay).raw();
  const uint32_t root =
      square_root(static_cast<uint64_t>(lead * lead + 2 * a * shortest_warning(params).raw()));
  return Speed::from_raw(saturate32(static_cast<int64_t>(root) - lead));
}

}  // namespace whisker::safety
