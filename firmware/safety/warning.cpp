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

Duration warning_delay(const Params& params, bool readings_err) noexcept {
  const RangefinderParams& r = params.rangefinders;
  const int32_t readings = readings_err ? kAgreeing : kReadings;
  return r.latency + milliseconds(readings * 1000 / r.rate_hz) + derived::settle_time(params);
}

Speed warned_speed(const Params& params, bool readings_err) noexcept {
  return planning::stopping_speed(shortest_warning(params), warning_delay(params, readings_err), params);
}

}  // namespace whisker::safety
