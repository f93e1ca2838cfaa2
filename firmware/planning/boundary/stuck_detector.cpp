#include "firmware/planning/boundary/stuck_detector.hpp"

namespace whisker::planning {
namespace {

constexpr AngularRate kTurns = 300_mrad_per_s;
constexpr int32_t kTicks = 16;  // at least

}  // namespace

bool StuckDetector::stalled(const View& view, Duration patience, const Params& params) noexcept {
  const Speed slow = params.wheels.max_speed / 15;
  const bool turns = abs(view.turning) > kTurns * (params.body.track / 2);
  const bool held = !turns && view.held_back();
  // A single long tick, in which the body could not start, says nothing.
  const Duration elapsed = min(view.elapsed, patience / kTicks);
  slow_for_ = view.forward < slow ? slow_for_ + elapsed * (held ? 4 : 1) : Duration{};
  return slow_for_ >= patience;
}

Duration patience(const Params& params) noexcept {
  const Duration starts = params.wheels.motor_lag * 2 + params.rangefinders.latency +
                          milliseconds(4000 / params.rangefinders.rate_hz);
  return starts * 4;
}

}  // namespace whisker::planning
