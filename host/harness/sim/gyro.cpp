#include "host/harness/sim/gyro.hpp"

#include "host/harness/sim/streams.hpp"

namespace whisker::sim {
namespace {

constexpr int32_t kLimit = 32767;

double drawn(double sigma, uint64_t seed, uint32_t stream) { return sigma * Random(seed, stream).normal(); }

}  // namespace

Gyro::Gyro(const RobotSpec& robot, const NoiseSpec& noise, uint64_t seed)
    : per_radian_(32768 / robot.gyro_range),
      interval_s_(1 / robot.gyro_rate_hz),
      latency_s_(robot.gyro_latency_s),
      scale_(1 + drawn(noise.gyro_scale_sigma, seed, kStreamGyroScale)),
      bias_(drawn(noise.gyro_bias_radps, seed, kStreamGyroBias)),
      warm_up_(drawn(noise.gyro_warm_up_radps, seed, kStreamGyroWarmUp)),
      noise_(noise.gyro_walk_rad_per_sqrt_s * square_root(robot.gyro_rate_hz)),
      walk_(seed, kStreamGyroWalk) {}

void Gyro::turn(double angle, int64_t from_us, int64_t to_us) {
  const double from_s = static_cast<double>(from_us) * 1e-6;
  const double to_s = static_cast<double>(to_us) * 1e-6;
  double done = 0;
  for (;;) {
    const double end_s = static_cast<double>(taken_ + 1) * interval_s_;
    // A nanosecond of rounding.
    if (end_s > to_s + 1e-9) break;
    const double part = (end_s - from_s) / (to_s - from_s);
    const double share = part > 1 ? 1 : part;
    angle_ += angle * (share - done);
    done = share;
    sample(end_s);
  }
  angle_ += angle * (1 - done);
}

void Gyro::sample(double end_s) {
  const double warm = end_s < kWarmUp ? end_s / kWarmUp : 1;
  const double rate = angle_ / interval_s_ * scale_ + bias_ + warm_up_ * warm;
  const double noise = noise_ > 0 ? noise_ * walk_.normal() : 0;
  const double units = (rate + noise) * per_radian_;
  const bool saturated = !(units > -kLimit && units < kLimit);
  const int32_t value =
      saturated ? (units < 0 ? -kLimit : kLimit) : static_cast<int32_t>(whole_below(units + 0.5));
  const hal::GyroReading& last = at_[taken_ % kInTransit];
  ++taken_;
  at_[taken_ % kInTransit] = {last.sum + static_cast<uint32_t>(value),
                              static_cast<uint16_t>(last.samples + 1),
                              static_cast<uint16_t>(last.saturated + (saturated ? 1 : 0))};
  angle_ = 0;
}

hal::GyroReading Gyro::read(int64_t now_us) const {
  const double ended_s = static_cast<double>(now_us) * 1e-6 - latency_s_;
  int64_t arrived = whole_below(ended_s / interval_s_ + 1e-6);
  if (arrived < 0) arrived = 0;
  if (arrived > taken_) arrived = taken_;
  return at_[arrived % kInTransit];
}

}  // namespace whisker::sim
