#include "firmware/localization/gyro_bias.hpp"

namespace whisker::localization {
namespace {

constexpr int32_t kLargestStep = 328;  // units of a sample
constexpr Duration kForever = milliseconds(1000000000);
// A change that was learned is followed no longer than two rests are apart.
constexpr Duration kFollows = GyroBias::kServes * 2;
constexpr Duration kShortest = 100_ms;
// Counts of a way of track / kFineCounts are so fine that kWait is enough.
constexpr int32_t kFineCounts = 650;
// Leaves kFirstRest of the longest rest.
constexpr Duration kLongestWait = 2850_ms;

int32_t samples_in(Duration time, int32_t rate_hz) noexcept { return time.raw() * rate_hz / 1000; }

}  // namespace

int32_t scaled_range(const GyroParams& params) noexcept {
  return multiply_divide(params.range.raw(), params.scale.raw(), 1000000);
}

int32_t rate_of(int32_t sample, const GyroParams& params) noexcept {
  return multiply_divide(sample, scaled_range(params), 128000000);
}

[[gnu::noinline]] int32_t GyroBias::value() const noexcept {
  return saturate32(value_ + scale_down<16>(int64_t{change_} * min(measured_for_, kFollows).raw()));
}

void GyroBias::configure(const Params& params) noexcept {
  const Duration lag = params.wheels.motor_lag;
  wait_ = max(kWait, lag * 6 - kWait);
  // After the last count, less than a count of way is left. It halves in 0.7 of the lag.
  const Length fine = params.body.track / kFineCounts;
  for (Length left = derived::encoder_count(params); left > fine; left = left / 2) wait_ += lag * 7 / 10;
  wait_ = min(wait_, kLongestWait);
}

void GyroBias::pass(bool still, Duration elapsed) noexcept {
  measured_for_ = min(measured_for_ + elapsed, kForever);
  used_for_ = min(used_for_ + elapsed, kForever);
  still_for_ = still ? min(still_for_ + elapsed, kForever) : Duration{};
}

bool GyroBias::add(int32_t sum, int32_t samples) noexcept {
  const int64_t apart = int64_t{sum} * 65536 - int64_t{value()} * samples;  // 2^-16 units
  const int64_t most = int64_t{kLargestStep} * samples * 65536;
  if (known_ && (apart > most || apart < -most)) return false;
  samples_ = narrow<uint16_t>(samples_ + samples);
  sum_ += sum;
  if (known_ && still_for_ > wait_ + (in_doubt_ ? kRestInDoubt : kRest)) used_for_ = Duration{};
  return true;
}

bool GyroBias::take(const GyroParams& params, Mean& mean) noexcept {
  const bool ended = known_ && !stands();
  const Duration enough = ended ? kShortest : known_ ? kRest : kFirstRest;
  if (samples_ == 0 || samples_ < samples_in(enough, params.rate_hz)) {
    if (ended) sum_ = samples_ = 0;
    return false;
  }
  const int32_t measured = saturate32(divide_rounded(int64_t{sum_} * 65536, samples_));
  mean.first = !known_;
  mean.lasted = milliseconds(multiply_divide(samples_, 1000, params.rate_hz));
  sum_ = samples_ = 0;
  if (mean.first) {
    known_ = true;
    value_ = measured;
    measured_for_ = Duration{};
    if (still_for_ > kRest) used_for_ = Duration{};
  }
  mean.off = saturate32(int64_t{measured} - value());
  mean.off_rad = rate_of(mean.off, params);
  return true;
}

void GyroBias::learn(int32_t off, int32_t bias, int32_t change) noexcept {
  value_ = saturate32(value() + scale_down<16>(int64_t{off} * bias));
  change_ = saturate32(change_ + scale_down<16>(int64_t{off} * change));
  measured_for_ = Duration{};
}

}  // namespace whisker::localization
