#include "host/harness/sim/range_sensors.hpp"

#include "host/harness/sim/elementary.hpp"
#include "host/harness/sim/streams.hpp"
#include "host/harness/sim/tapered_cone.hpp"

namespace whisker::sim {
namespace {

int64_t nearest(double x) { return whole_below(x + 0.5); }

uint16_t millimetres_of(double metres) {
  const int64_t mm = nearest(metres * 1000);
  return static_cast<uint16_t>(mm < 0 ? 0 : mm > hal::kMostMm ? hal::kMostMm : mm);
}

hal::RangeReading without_distance(hal::RangeStatus status) { return {0, status, 0, 0}; }

}  // namespace

RangeSensors::RangeSensors(const RobotSpec& robot, const NoiseSpec& noise, uint64_t seed)
    : robot_(robot),
      noise_(noise),
      interval_us_(1e6 / robot.rate_hz),
      latency_us_(nearest(robot.latency_s * 1e6)),
      directions_{Direction(robot.beams[0]), Direction(robot.beams[1]), Direction(robot.beams[2])},
      sin_incidence_(robot.incidence < kPi / 2 ? sin_cos(robot.incidence).sin : 1.0),
      faults_{{seed, hal::kLeft}, {seed, hal::kFront}, {seed, hal::kRight}} {}

RangeSensors::Faults::Faults(uint64_t seed, uint32_t beam)
    : noise(seed, kStreamRangeNoise + beam),
      dropout(seed, kStreamDropout + beam),
      false_clear(seed, kStreamFalseClear + beam),
      phantom(seed, kStreamPhantom + beam),
      crosstalk(seed, kStreamCrosstalk + beam),
      cover_glass(seed, kStreamCoverGlass + beam) {}

void RangeSensors::measure(const WorldView& world, const Pose& pose) {
  const double t = static_cast<double>(due_us_) * 1e-6;
  const SinCos heading = sin_cos(pose.heading);
  const Vec2 front{heading.cos, heading.sin};
  const Vec2 left_of_front{-heading.sin, heading.cos};

  Measurement& m = kept_[count_ % kKept];
  m.at_us = due_us_;
  double metres[hal::kBeams];
  bool dark[hal::kBeams];
  for (int i = 0; i < hal::kBeams; ++i) {
    const BeamSpec& beam = robot_.beams[i];
    const Direction& d = directions_[i];
    const double within = beam.max_range / robot_.range_scale;
    const double bright = robot_.echo_range < within ? robot_.echo_range : within;
    const Cone cone{pose.at + front * beam.x + left_of_front * beam.y,
                    front * d.axis.cos + left_of_front * d.axis.sin,
                    d.half_width.cos,
                    d.half_width.sin,
                    sin_incidence_,
                    robot_.corner_scatter};
    const auto seen_within = [&](double limit) { return seen(cone, beam.cone_half_width, world, t, limit); };
    metres[i] = seen_within(bright);
    dark[i] = robot_.dark_is_invalid && bright < within && seen_within(within) < within;
  }
  for (int i = 0; i < hal::kBeams; ++i) {
    m.readings.beam[i] = classified(i, echo(i, metres), dark[i]);
    m.readings.beam[i].sequence = static_cast<uint8_t>(count_ & 15);
  }
  ++count_;
  due_us_ = nearest(static_cast<double>(count_) * interval_us_);
}

double RangeSensors::seen(const Cone& cone, double half_width, const WorldView& world, double t,
                          double limit) const {
  if (robot_.cone_far_half_width >= half_width) {
    return range(cone, world, t, limit, robot_.soft_range);
  }
  const TaperedCone tapered(cone, half_width, robot_.cone_far_half_width, robot_.taper_range);
  return range(tapered, world, t, limit, robot_.soft_range);
}

double RangeSensors::echo(int i, const double (&metres)[hal::kBeams]) {
  double nearest = metres[i];
  // Every source draws on every measurement, so that the seed's numbers do not depend on the world.
  if (robot_.crosstalk > 0 && faults_[i].crosstalk.uniform() < robot_.crosstalk) {
    if (i > 0 && metres[i - 1] < nearest) nearest = metres[i - 1];
    if (i + 1 < hal::kBeams && metres[i + 1] < nearest) nearest = metres[i + 1];
  }
  nearest *= robot_.range_scale;
  if (robot_.cover_glass > 0 && faults_[i].cover_glass.uniform() < robot_.cover_glass) {
    if (nearest > robot_.beams[i].max_range) nearest = robot_.cover_glass_at;
  }
  if (robot_.phantom > 0) {
    const bool phantom = faults_[i].phantom.uniform() < robot_.phantom;
    const double at = 0.1 + 0.4 * faults_[i].phantom.uniform();
    if (phantom && nearest > robot_.beams[i].max_range) nearest = at;
  }
  return nearest;
}

// The errors of the sensor and of [noise] are independent, so their variances add.
double RangeSensors::sigma(double metres) const {
  const double share = robot_.range_sigma_share * metres;
  const double own2 = robot_.range_sigma * robot_.range_sigma + share * share;
  return own2 > 0 ? square_root(own2 + noise_.range_sigma_m * noise_.range_sigma_m) : noise_.range_sigma_m;
}

hal::RangeReading RangeSensors::classified(int i, double metres, bool dark) {
  Faults& faults = faults_[i];
  const BeamSpec& beam = robot_.beams[i];
  const bool noisy = noise_.range_sigma_m > 0 || robot_.range_sigma > 0 || robot_.range_sigma_share > 0;
  const double deviate = noisy ? faults.noise.normal() : 0.0;
  const bool lost = faults.dropout.uniform() < noise_.range_dropout;
  const bool false_clear = faults.false_clear.uniform() < noise_.range_false_clear;

  if (lost) return without_distance(hal::RangeStatus::invalid);
  if (false_clear) return without_distance(hal::RangeStatus::clear);
  if (metres > beam.max_range) {
    return without_distance(dark ? hal::RangeStatus::invalid : hal::RangeStatus::clear);
  }
  const bool folds = robot_.near_is_farther && metres < beam.min_range;
  if (folds) metres = metres > 0 ? beam.min_range * beam.min_range / metres : beam.max_range * 2;
  const double measured = metres + sigma(metres) * deviate;
  if (measured > beam.max_range) return without_distance(hal::RangeStatus::clear);
  if (measured < beam.min_range && !folds) return without_distance(hal::RangeStatus::too_near);
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
