#include "firmware/safety/warning.hpp"

#include "firmware/math/trig.hpp"
#include "firmware/params/relations.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::safety {
namespace {

// Until an echo counts: the next one of the beam; of readings that often err, three that agree.
constexpr int32_t kReadings = 1;
constexpr int32_t kAgreeing = 3;

}  // namespace

Length shortest_warning(const Params& params) noexcept {
  const Q30 seen = sin(params.rangefinders.incidence);
  const Q30 edge = sin(Angle::from_raw(relations::beams(params.rangefinders).outermost));
  const int64_t way = quotient(int64_t{params.body.radius.raw()} * seen.raw(), edge.raw());
  return Length::from_raw(saturate32(way)) * 2 / 3;
}

Duration warning_delay(const Params& params, bool readings_err) noexcept {
  const RangefinderParams& r = params.rangefinders;
  const int32_t readings = readings_err ? kAgreeing : kReadings;
  return r.latency + milliseconds(readings * 1000 / r.rate_hz) + derived::settle_time(params);
}

Speed warned_speed(const Params& params, bool readings_err) noexcept {
  return planning::stopping_speed(shortest_warning(params), warning_delay(params, readings_err), params);
}

}  // namespace whisker::safety
