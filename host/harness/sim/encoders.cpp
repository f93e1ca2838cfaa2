#include "host/harness/sim/encoders.hpp"

#include "host/harness/sim/streams.hpp"

namespace whisker::sim {
namespace {

uint32_t wrapped_count(double counts) {
  return static_cast<uint32_t>(static_cast<uint64_t>(whole_below(counts)) & (hal::kEncoderModulus - 1));
}

}  // namespace

Encoders::Encoders(const RobotSpec& robot, const NoiseSpec& noise, uint64_t seed)
    : counts_per_m_{},
      drift_per_sqrt_m_(noise.heading_drift_rad_per_sqrt_m * robot.track / 2),
      walk_(seed, kStreamDrift) {
  Random scale(seed, kStreamWheelScale);
  Random common(seed, kStreamWheelScaleCommon);
  const double both = noise.wheel_scale_common_sigma * common.normal();
  for (double& counts_per_m : counts_per_m_) {
    counts_per_m = robot.counts_per_m * (1 + noise.wheel_scale_sigma * scale.normal() + both);
  }
  const double skew = (robot.wheel_ratio - 1) / (robot.wheel_ratio + 1);
  counts_per_m_[0] /= 1 - skew;
  counts_per_m_[1] /= 1 + skew;
}

void Encoders::roll(double left, double right, double path) {
  distance_[0] += left;
  distance_[1] += right;
  if (drift_per_sqrt_m_ > 0) drift_ += drift_per_sqrt_m_ * square_root(path) * walk_.normal();
}

hal::EncoderCounts Encoders::counts() const {
  return {wrapped_count((distance_[0] - drift_) * counts_per_m_[0]),
          wrapped_count((distance_[1] + drift_) * counts_per_m_[1])};
}

}  // namespace whisker::sim
