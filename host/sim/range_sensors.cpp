#include "host/sim/range_sensors.hpp"

#include "host/sim/cone.hpp"
#include "host/sim/elementary.hpp"
#include "host/sim/streams.hpp"

namespace whisker::sim {
namespace {

int64_t nearest(double x) { return whole_below(x + 0.5); }

uint16_t millimetres_of(double metres) {
  constexpr int64_t kMost = 65533;
  const int64_t mm = nearest(metres * 1000);
  return static_cast<uint16_t>(mm < 0 ? 0 : mm > kMost ? kMost : mm);
}

hal::RangeReading without_distance(hal::RangeStatus status) { return {0, status, 0, 0}; }

}  // namespace

RangeSensors::RangeSensors(const RobotSpec& robot, const NoiseSpec& noise, uint64_t seed)
    : interval_us_(1e6 / robot.rate_hz),
      latency_us_(nearest(robot.latency_s * 1e6)),
      offset_(robot.offset),
      min_range_(robot.min_range),
      max_range_(robot.max_range),
      side_(sin_cos(robot.side_angle)),
      half_width_(sin_cos(robot.cone_half_width)),
      sin_incidence_(robot.incidence < kPi / 2 ? sin_cos(robot.incidence).sin : 1.0),
      scale_(robot.range_scale),
      phantom_(robot.phantom),
      crosstalk_(robot.crosstalk),
      noise_(noise),
      faults_{{seed, hal::kLeft}, {seed, hal::kFront}, {seed, hal::kRight}} {}

RangeSensors::Faults::Faults(uint64_t seed, uint32_t beam)
    : noise(seed, kStreamRangeNoise + beam),
      dropout(seed, kStreamDropout + beam),
      false_clear(seed, kStreamFalseClear + beam),
      phantom(seed, kStreamPhantom + beam),
      crosstalk(seed, kStreamCrosstalk + beam) {}

void RangeSensors::measure(const WorldView& world, const Pose& pose) {
  const double t = static_cast<double>(due_us_) * 1e-6;
  const SinCos heading = sin_cos(pose.heading);
  const Vec2 front{heading.cos, heading.sin};
  const Vec2 left_of_front{-heading.sin, heading.cos};
  const Vec2 axes[hal::kBeams] = {front * side_.cos + left_of_front * side_.sin, front,
                                  front * side_.cos - left_of_front * side_.sin};

  Measurement& m = kept_[count_ % kKept];
  m.at_us = due_us_;
  double metres[hal::kBeams];
  for (int i = 0; i < hal::kBeams; ++i) {
    const Cone cone{pose.at + axes[i] * offset_, axes[i], half_width_.cos, half_width_.sin, sin_incidence_};
    metres[i] = range(cone, world, t, max_range_ / scale_);
  }
  for (int i = 0; i < hal::kBeams; ++i) {
    m.readings.beam[i] = classified(faults_[i], echo(i, metres));
    m.readings.beam[i].sequence = static_cast<uint8_t>(count_ & 15);
  }
  ++count_;
  due_us_ = nearest(static_cast<double>(count_) * interval_us_);
}

double RangeSensors::echo(int i, const double (&metres)[hal::kBeams]) {
  double nearest = metres[i];
  // Both sources draw on every measurement, so that the seed's numbers do not depend on the world.
  if (crosstalk_ > 0 && faults_[i].crosstalk.uniform() < crosstalk_) {
    if (i > 0 && metres[i - 1] < nearest) nearest = metres[i - 1];
    if (i + 1 < hal::kBeams && metres[i + 1] < nearest) nearest = metres[i + 1];
  }
  nearest *= scale_;
  if (phantom_ <= 0) return nearest;
  const bool phantom = faults_[i].phantom.uniform() < phantom_;
  const double at = 0.1 + 0.4 * faults_[i].phantom.uniform();
  return phantom && nearest > max_range_ ? at : nearest;
}

hal::RangeReading RangeSensors::classified(Faults& faults, double metres) const {
  const double error = noise_.range_sigma_m > 0 ? noise_.range_sigma_m * faults.noise.normal() : 0.0;
  const bool lost = faults.dropout.uniform() < noise_.range_dropout;
  const bool false_clear = faults.false_clear.uniform() < noise_.range_false_clear;

  if (lost) return without_distance(hal::RangeStatus::invalid);
  if (false_clear || metres > max_range_) return without_distance(hal::RangeStatus::clear);
  const double measured = metres + error;
  if (measured > max_range_) return without_distance(hal::RangeStatus::clear);
  if (measured < min_range_) return without_distance(hal::RangeStatus::too_near);
  return {millimetres_of(measured), hal::RangeStatus::ok, 0, 0};
}

hal::RangeReadings RangeSensors::read(int64_t now_us) const {
  constexpr int64_t kOldest = 255;
  for (int64_t k = count_ - 1; k >= 0 && k >= count_ - kKept; --k) {
    const Measurement& m = kept_[k % kKept];
    if (m.at_us + latency_us_ > now_us) continue;
    hal::RangeReadings arrived = m.readings;
    const int64_t age = (now_us - m.at_us + 500) / 1000;
    for (hal::RangeReading& reading : arrived.beam) {
      reading.age_ms = static_cast<uint8_t>(age < kOldest ? age : kOldest);
    }
    return arrived;
  }
  constexpr hal::RangeReading kNone{0, hal::RangeStatus::stale, 255, 15};
  return {{kNone, kNone, kNone}};
}

}  // namespace whisker::sim
