#include "firmware/nav/stall.hpp"

namespace whisker::nav {
namespace {

constexpr AngularRate kTurns = 300_mrad_per_s;

}  // namespace

bool Stall::stalled(const View& view, int32_t patience, const Params& params) noexcept {
  const Speed slow = params.wheels.max_speed / 15;
  const bool turns = abs(view.turning) > kTurns * (params.body.track / 2);
  const bool held = !turns && view.granted < Q14::ratio(1, 1);
  slow_ticks_ = view.forward < slow ? slow_ticks_ + (held ? 4 : 1) : 0;
  return slow_ticks_ >= patience;
}

int32_t patience(const Params& params) noexcept {
  const Duration starts = params.wheels.motor_lag * 2 + params.rangefinders.latency +
                          milliseconds(4000 / params.rangefinders.rate_hz);
  return 4 * starts.raw() / params.safety.period.raw();
}

}  // namespace whisker::nav
