#include "firmware/localization/wheel_gains.hpp"

namespace whisker::localization {
namespace {

// Standard deviations before the first stretch: 3 % of track and common scale, 2 % between the wheels. The
// floors keep it learning.
constexpr int32_t kGainVariance = 3865471;
constexpr int32_t kSkewVariance = 1717987;
constexpr int32_t kLeastGainVariance = 17180;  // 0.2 %
constexpr int32_t kLeastSkewVariance = 172;    // 0.02 %
constexpr uint8_t kStraight = 3;               // steps without turning: longer than the latency of a gyro
constexpr int32_t kSlipDegrees = 3;            // an error below this is no slip
constexpr int32_t kCounts = 4 * 256;           // variance of the rounding of counts, 2^-8 square counts
constexpr int32_t kSigmas = 3;                 // declared ones, that gains may reach

int32_t limited(int32_t x, int32_t most) noexcept { return x > most ? most : x < -most ? -most : x; }

/// 2^-24, of standard deviations.
int32_t most(Ratio sigma) noexcept {
  return multiply_divide(sigma.raw(), kSigmas * (INT32_C(1) << 24), 1000000);
}

/// 2^-32, of one.
int32_t variance(int32_t most) noexcept {
  return saturate32(quotient(square(most), kSigmas * kSigmas * INT32_C(65536)));
}

/// What remains of a variance after an observation with this share of it.
int32_t remaining(int32_t variance, int64_t part, int64_t whole, int32_t least) noexcept {
  const int64_t share = divide_rounded_64(part * (INT32_C(1) << 20), whole);
  const int32_t rest = variance - narrow<int32_t>(scale_down<20>(variance * share));
  return rest < least ? least : rest;
}

}  // namespace

void WheelGains::configure(const Params& params, const Odometry& odometry) noexcept {
  counts_per_turn_ = odometry.counts_per_turn();
  least_way_ = params.wheels.counts_per_metre * 3 / 5;  // 0.3 m by two wheels
  least_turn_ = counts_per_turn_ / 12;
  // The mean of two wheels is off by 1 / sqrt(2) of one, and so is half of their difference.
  const PoseErrorParams& e = params.pose_error;
  const Ratio half = millionths(multiply_divide(e.wheel_scale.raw(), 70711, 100000));
  most_gain_ = most(half + e.wheel_scale_common);
  most_skew_ = most(half);
  gain_variance_ = kGainVariance;
  skew_variance_ = kSkewVariance;
}

void WheelGains::expect_declared() noexcept {
  gain_variance_ = variance(most_gain_);
  skew_variance_ = variance(most_skew_);
}

int32_t WheelGains::difference(const CountStep& step) const noexcept {
  return saturate32(scale_down<12>(int64_t{limited(gain_, most_gain_)} * (step.right - step.left) +
                                   int64_t{limited(skew_, most_skew_)} * (step.right + step.left)));
}

void WheelGains::drop() noexcept {
  now_ = {};
  straight_ = 0;
}

bool WheelGains::teaches(const Stretch& stretch) const noexcept {
  return magnitude(stretch.way) >= static_cast<uint32_t>(least_way_) ||
         magnitude(stretch.turn) >= static_cast<uint32_t>(least_turn_);
}

int64_t WheelGains::counts_of(int32_t turn) const noexcept {
  return scale_down<28>(int64_t{turn} * counts_per_turn_);  // 2^-4 counts
}

int64_t WheelGains::noise_of(Angle sigma) const noexcept { return square(counts_of(sigma.wrapped())); }

Ratio WheelGains::skew_sigma() const noexcept {
  return millionths(
      narrow<int32_t>(uint64_t{square_root_32(narrow<uint32_t>(skew_variance_))} * 1000000 >> 16));
}

bool WheelGains::compare(const CountStep& step, Angle gyro, Angle nominal) noexcept {
  const int32_t difference = step.right - step.left;
  now_.way = saturating_add(now_.way, step.left + step.right);
  now_.turn = saturating_add(now_.turn, difference);
  now_.error = saturating_add(now_.error, (gyro - nominal).wrapped());
  straight_ =
      magnitude(difference) > 2 ? uint8_t{0} : static_cast<uint8_t>(straight_ + (straight_ < kStraight));
  return straight_ == kStraight && teaches(now_) && finish();
}

bool WheelGains::finish() noexcept {
  const Stretch stretch = now_;
  drop();
  const int64_t slip = quotient(int64_t{counts_per_turn_} * kSlipDegrees * 16, 360);
  // Of the floor.
  return observe(stretch, (magnitude(stretch.way) + magnitude(stretch.turn)) / 2, slip);
}

/// A Kalman filter without covariances between the two: a stretch of a mission is nearly always either
/// straight or a turn on the spot.
bool WheelGains::observe(const Stretch& stretch, int64_t noise, int64_t slip) noexcept {
  const int32_t way = stretch.way;
  const int32_t turn = stretch.turn;
  // Beyond these the products do not fit; such a stretch teaches little.
  constexpr uint32_t kMost = UINT32_C(1) << 18;
  if (magnitude(way) > kMost || magnitude(turn) > kMost) return false;
  const int64_t error =
      counts_of(stretch.error) - scale_down<20>(int64_t{gain_} * turn + int64_t{skew_} * way);
  // Variances of the error in 2^-8 square counts.
  const int64_t by_skew = scale_down<24>(square(way) * skew_variance_);
  const int64_t by_gain = scale_down<24>(square(turn) * gain_variance_);
  const int64_t all = by_skew + by_gain + noise + kCounts;
  if (square(error) > 16 * all + square(slip)) return true;

  const auto learned = [&](int32_t variance, int32_t counts) {
    const int64_t share = divide_rounded_64(int64_t{variance} * counts * 65536, all);
    return scale_down<20>(share * error);
  };
  skew_ = saturating_add(skew_, learned(skew_variance_, way));
  gain_ = saturating_add(gain_, learned(gain_variance_, turn));
  skew_variance_ = remaining(skew_variance_, by_skew, all, kLeastSkewVariance);
  gain_variance_ = remaining(gain_variance_, by_gain, all, kLeastGainVariance);
  return false;
}

}  // namespace whisker::localization
