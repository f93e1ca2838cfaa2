#include "host/harness/sim/slip.hpp"

#include "host/harness/sim/elementary.hpp"
#include "host/harness/sim/streams.hpp"

namespace whisker::sim {
WheelSlip::WheelSlip(const RobotSpec& robot, const NoiseSpec& noise, uint64_t seed, uint32_t wheel)
    : mean_(noise.wheel_slip),
      least_growth_(robot.max_acceleration / 20),
      shares_(seed, kStreamWheelSlip + wheel) {}

double WheelSlip::ground(double speed_before, const WheelStep& step, double step_s) {
  if (!(mean_ > 0)) return step.distance;
  const bool before = speeds_up_;
  speeds_up_ = size_of(step.speed) - size_of(speed_before) > least_growth_ * step_s;
  if (speeds_up_ && !before) share_ = 2 * mean_ * shares_.uniform();
  return speeds_up_ ? step.distance * (1 - share_) : step.distance;
}

}  // namespace whisker::sim
