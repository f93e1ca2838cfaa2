#include "firmware/localization/bias_filter.hpp"

#include "firmware/math/fixed.hpp"

namespace whisker::localization {
namespace {

// The bias wanders by 0.002 deg/s in 100 s, its change by 7.5e-5 deg/s^2 in 300 s.
constexpr int32_t kWanders = 3378;        // (rad/s)^2 2^-48 per s
constexpr int32_t kChangeWanders = 6917;  // (rad/s^2)^2 2^-60 per s
constexpr int64_t kRounding = 64;         // of the mean of the samples, (rad/s)^2 2^-48
constexpr int64_t kSurprise = 16;         // variances of what is off: the bias has changed otherwise

// Called, not inlined: each holds a product of 64 bits.
[[gnu::noinline]] int64_t product(int64_t a, int32_t b) noexcept { return scale_down<20>(a * b); }
[[gnu::noinline]] int64_t over(int64_t a, int64_t b, int64_t divisor) noexcept {
  return divide_rounded_64(a * b, divisor);
}

/// Of a mean of samples, (rad/s)^2 2^-48.
int32_t variance(int32_t walk, Duration lasted) noexcept {
  return saturate32(divide_rounded(int64_t{walk} * 3906250, lasted.raw()) / 1000 + kRounding);
}

}  // namespace

void BiasFilter::configure(int32_t change) noexcept { change_ = saturate32(square(change)); }

void BiasFilter::begin(Duration lasted, int32_t walk) noexcept { of_bias_[kBias] = variance(walk, lasted); }

void BiasFilter::forget() noexcept {
  for (int i = 0; i < kPose; ++i) of_bias_[i] = of_change_[i] = 0;
}

BiasFilter::Covariance BiasFilter::step(int32_t x, int32_t y, Duration elapsed, bool by_gyro) noexcept {
  Covariance grows{};
  if (!begun()) return grows;
  const int32_t ms = elapsed.raw();
  const int32_t turns = by_gyro ? ms : 0;
  const int32_t bias = of_bias_[kBias];
  grows.heading =
      over(-int64_t{of_bias_[kHeading]}, turns, 8000) + over(int64_t{bias} * turns, turns, 256000000);
  grows.x_heading = over(-int64_t{of_bias_[kX]}, turns, 16000);
  grows.y_heading = over(-int64_t{of_bias_[kY]}, turns, 16000);

  const auto drag = [x, y](int32_t(&with)[kRows], int64_t turned) {
    with[kX] = saturated_sum(with[kX], -product(y, with[kHeading]));
    with[kY] = saturated_sum(with[kY], product(x, with[kHeading]));
    with[kHeading] = saturated_sum(with[kHeading], -turned);
  };
  for (int i = 0; i < kRows; ++i) of_bias_[i] = saturated_sum(of_bias_[i], over(of_change_[i], ms, 64000));
  drag(of_bias_, over(bias, turns, 16000));
  of_bias_[kBias] =
      saturated_sum(of_bias_[kBias], over(of_change_[kBias], ms, 64000) + over(kWanders, ms, 1000));
  drag(of_change_, over(of_change_[kBias], turns, 16000));
  of_change_[kBias] = saturated_sum(of_change_[kBias], over(change_, ms, 64000));
  change_ = saturated_sum(change_, over(kChangeWanders, ms, 1000));
  return grows;
}

BiasFilter::Learned BiasFilter::measure(int32_t off, Duration lasted, int32_t walk,
                                        Covariance& shrinks) noexcept {
  const int32_t noise = variance(walk, lasted);
  int32_t& bias = of_bias_[kBias];
  if (square(off) / kSurprise > int64_t{bias} + noise) bias = saturated_sum(bias, square(off));
  const int64_t both = int64_t{bias} + noise;
  const auto share = [both](int32_t a, int32_t b) { return over(a, b, both); };

  const int32_t* const with = of_bias_;
  shrinks = {share(with[kHeading], with[kHeading]),
             share(with[kX], with[kHeading]),
             share(with[kY], with[kHeading]),
             share(with[kX], with[kX]),
             share(with[kX], with[kY]),
             share(with[kY], with[kY])};
  Learned learned{};
  learned.bias = saturate32(share(bias, 65536));
  const int32_t mixed = of_change_[kBias];
  learned.change = saturate32(share(mixed, 67109));
  learned.ahead = {saturate32(share(with[kX], off)), saturate32(share(with[kY], off)),
                   saturate32(share(with[kHeading], off))};

  change_ = saturated_sum(change_, -share(mixed, mixed));
  if (change_ < 0) change_ = 0;
  for (int i = 0; i < kRows; ++i) {
    of_change_[i] = saturated_sum(of_change_[i], -share(of_bias_[i], mixed));
    of_bias_[i] = saturate32(share(of_bias_[i], noise));
  }
  return learned;
}

void BiasFilter::correct_heading(int64_t share, int64_t x, int64_t y) noexcept {
  const int64_t by[kPose] = {x, y, share * 16};
  for (int i = 0; i < kPose; ++i) {
    of_bias_[i] = saturated_sum(of_bias_[i], -product(by[i], of_bias_[kHeading]));
    of_change_[i] = saturated_sum(of_change_[i], -product(by[i], of_change_[kHeading]));
  }
}

}  // namespace whisker::localization
