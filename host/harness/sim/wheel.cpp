#include "host/harness/sim/wheel.hpp"

#include "host/harness/sim/elementary.hpp"

namespace whisker::sim {

WheelModel::WheelModel(double lag_s, double max_acceleration, double step_s)
    : lag_(lag_s),
      max_acceleration_(max_acceleration),
      step_(step_s),
      decay_(lag_s > 0 ? exponential(-step_s / lag_s) : 0.0) {}

WheelStep WheelModel::step(double v, double target) const {
  // Otherwise a stopping wheel would pass through the subnormal numbers, which are slow.
  constexpr double kSettled = 1e-12;

  const double remainder = target - v;
  const double size = remainder < 0 ? -remainder : remainder;
  if (size < kSettled) return {target, target * step_};

  const double lagging = max_acceleration_ * lag_;  // the remainder at which the limit ends
  if (size <= lagging) {
    const double left = remainder * decay_;
    return {target - left, target * step_ - (remainder - left) * lag_};
  }

  const double acceleration = remainder < 0 ? -max_acceleration_ : max_acceleration_;
  const double limited = (size - lagging) / max_acceleration_;
  if (limited >= step_) {
    double end = v + acceleration * step_;
    if ((target - end) * remainder < 0) end = target;  // because of rounding
    return {end, 0.5 * (v + end) * step_};
  }
  const double ramp_end = remainder < 0 ? target + lagging : target - lagging;
  const double ramp = 0.5 * (v + ramp_end) * limited;
  const double rest = step_ - limited;
  const double start = target - ramp_end;
  const double left = lag_ > 0 ? start * exponential(-rest / lag_) : 0.0;
  return {target - left, ramp + target * rest - (start - left) * lag_};
}

}  // namespace whisker::sim
