#include "firmware/localization/gyro_bias.hpp"

namespace whisker::localization {
namespace {

constexpr int32_t kLargestStep = 328;  // units of a sample
constexpr Duration kForever = milliseconds(1000000000);

int32_t samples_in(Duration time, int32_t rate_hz) noexcept { return time.raw() * rate_hz / 1000; }

}  // namespace

void GyroBias::pass(bool still, Duration elapsed) noexcept {
  used_for_ = min(used_for_ + elapsed, kForever);
  still_for_ = still ? min(still_for_ + elapsed, kForever) : Duration{};
  if (!still) rested_ = 0;
}

bool GyroBias::add(int32_t sum, int32_t samples) noexcept {
  const int64_t apart = int64_t{sum} * 65536 - int64_t{value_} * samples;  // 2^-16 units
  const int64_t most = int64_t{kLargestStep} * samples * 65536;
  if (known_ && (apart > most || apart < -most)) return false;
  if (rested_ == 0 && weight_ > 0) {
    // The bias may have changed since the last rest.
    const int32_t used_s = used_for_.raw() / 1000;
    weight_ = used_s >= 48 ? weight_ / 4 : weight_ - weight_ * used_s / 64;
  }
  rested_ += samples;
  weight_ = weight_ + samples;
  const int32_t most_weight = samples_in(kFirstRest, rate_hz_);
  if (weight_ > most_weight) weight_ = most_weight;
  value_ += saturate32(divide_rounded(apart, weight_));
  if (weight_ >= most_weight) known_ = true;
  if (known_ && rested_ >= samples_in(kRest, rate_hz_)) used_for_ = Duration{};
  return true;
}

}  // namespace whisker::localization
