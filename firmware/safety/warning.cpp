#include "firmware/safety/warning.hpp"

#include "firmware/math/trig.hpp"
#include "firmware/params/relations.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::safety {
namespace {

constexpr int32_t kReadings = 3;  // after the first one, until an echo counts

}  // namespace

Length shortest_warning(const Params& params) noexcept {
  const Q30 seen = sin(params.rangefinders.incidence);
  const Q30 edge = sin(Angle::from_raw(relations::beams(params.rangefinders).outermost));
  const int64_t way = int64_t{params.body.radius.raw()} * seen.raw() / edge.raw();
  return Length::from_raw(saturate32(way)) * 2 / 3;
}

Speed warned_speed(const Params& params) noexcept {
  const RangefinderParams& r = params.rangefinders;
  const Duration delay = r.latency + milliseconds(kReadings * 1000 / r.rate_hz) + params.motion.settle;
  return planning::stopping_speed(shortest_warning(params), delay, params);
}

}  // namespace whisker::safety
