#include "firmware/localization/gyro_heading.hpp"

namespace whisker::localization {
namespace {

constexpr Duration kSilence = 100_ms;

}  // namespace

void GyroHeading::configure(const Params& params, const Odometry& odometry) noexcept {
  gains_.configure(params, odometry);
  bias_.configure(params);
  // A microradian per second for a second, in 2^-29 turn, times 2^20; 2^15 units are the range.
  constexpr int64_t kTurnPerMicroradian = 89596268;
  turn_per_unit_ = narrow<uint32_t>(divide_rounded_64(scaled_range(params.gyro) * kTurnPerMicroradian,
                                                      int64_t{params.gyro.rate_hz} * 1048576));
  most_samples_ = narrow<uint8_t>(params.gyro.rate_hz / 2 < 255 ? params.gyro.rate_hz / 2 : 255);
}

void GyroHeading::restart() noexcept {
  has_last_ = false;
  ahead_ = Angle{};
  gains_.drop();
}

GyroHeading::Samples GyroHeading::take(const Step& step, Health& health) noexcept {
  const hal::GyroReading* const reading = step.reading;
  if (reading == nullptr || (has_last_ && reading->samples == last_.samples)) {
    silent_for_ += step.elapsed;
    if (silent_for_ > kSilence && answers_) {
      answers_ = false;
      count(health.gyro_lost);
      restart();
    }
    return {};
  }
  const uint16_t samples = static_cast<uint16_t>(reading->samples - last_.samples);
  const Samples taken{as_signed(reading->sum - last_.sum), samples};
  const bool saturated = reading->saturated != last_.saturated;
  const bool possible = magnitude(taken.sum) <= uint32_t{samples} * 32768;
  const bool follows = has_last_ && possible && samples <= most_samples_;
  if (!follows) restart();
  last_ = *reading;
  has_last_ = answers_ = true;
  silent_for_ = Duration{};
  if (!follows) return {};
  if (!saturated) return taken;
  count(health.gyro_saturated);
  ahead_ = Angle{};
  gains_.drop();
  return {};
}

Angle GyroHeading::turned(Samples samples) const noexcept {
  const int64_t units = int64_t{samples.sum} * 65536 - int64_t{bias_.value()} * samples.count;
  const int64_t turn = scale_down<28>(units * turn_per_unit_);
  return Angle::from_raw(static_cast<uint32_t>(static_cast<uint64_t>(turn)));
}

Angle GyroHeading::turn(const Step& step, const Odometry& odometry, Health& health) noexcept {
  const bool still = step.counts.left == 0 && step.counts.right == 0 && !step.commanded;
  bias_.pass(still, step.elapsed);
  const Samples samples = take(step, health);
  const int64_t difference = odometry.difference(step.counts);
  const Angle nominal = odometry.turn_of(difference);
  const Angle wheels = odometry.turn_of(difference + gains_.difference(step.counts));
  if (!answers_) return wheels;
  if (samples.count == 0) {
    if (!bias_.known() || !has_last_) return wheels;
    ahead_ += wheels;
    learn(step.counts, wheels, nominal, health);
    return wheels;
  }
  Angle gyro = turned(samples);
  if (bias_.rests() && bias_.add(samples.sum, samples.count)) gyro = Angle{};
  if (!bias_.known()) return wheels;
  const Angle turn = gyro - ahead_;
  ahead_ = Angle{};
  learn(step.counts, turn, nominal, health);
  return turn;
}

void GyroHeading::learn(const CountStep& counts, Angle gyro, Angle nominal, Health& health) noexcept {
  if (gains_.compare(counts, gyro, nominal)) count(health.wheel_slips);
}

HeadingSource GyroHeading::source() const noexcept {
  if (!answers_) return HeadingSource::gyro_lost;
  return bias_.known() ? HeadingSource::gyro : HeadingSource::bias_unknown;
}

}  // namespace whisker::localization
