#include "firmware/localization/bias_filter.hpp"

#include "firmware/math/fixed.hpp"

namespace whisker::localization {
namespace {

// The bias wanders by 0.002 deg/s in 100 s, its change by 7.5e-5 deg/s^2 in 300 s.
constexpr int32_t kWanders = 3378;        // (rad/s)^2 2^-48 per s
constexpr int32_t kChangeWanders = 6917;  // (rad/s^2)^2 2^-60 per s
constexpr int64_t kSurprise = 16;         // variances of what is off: the bias has changed otherwise
// Room for the sum of two numbers, and for a finer unit.
constexpr int32_t kMost = INT32_C(1) << 30;
constexpr int32_t kFew = INT32_C(1) << 26;
constexpr uint8_t kCoarsest = 7;

// Called, not inlined: each holds a product of 64 bits.
[[gnu::noinline]] int64_t product(int64_t a, int32_t b) noexcept { return scale_down<20>(a * b); }
[[gnu::noinline]] int64_t over(int64_t a, int64_t b, int64_t divisor) noexcept {
  return divide_rounded_64(a * b, divisor);
}

/// Of x, within 1.
constexpr int32_t magnitude(int32_t x) noexcept { return x < 0 ? ~x : x; }

}  // namespace

void BiasFilter::configure(int32_t change) noexcept {
  rescale(square(change));
  change_ = in_unit(square(change));
}

void BiasFilter::begin(int64_t variance) noexcept {
  rescale(variance);
  of_bias_[kBias] = in_unit(variance);
}

/// At least 1.
[[gnu::noinline]] int32_t BiasFilter::in_unit(int64_t variance) const noexcept {
  const int64_t share = variance >> (2 * coarser_);
  return share < 1 ? 1 : saturate32(share);
}

void BiasFilter::rescale(int64_t variance) noexcept {
  for (;;) {
    int32_t most = in_unit(variance) | change_;
    for (int i = 0; i < kRows; ++i) most |= magnitude(of_bias_[i]) | magnitude(of_change_[i]);
    if (most >= kMost && coarser_ < kCoarsest) {
      scale(1);
    } else if (most < kFew && coarser_ > 0) {
      scale(-1);
    } else {
      return;
    }
  }
}

/// The unit becomes coarser by 2^by, which is 2 or 1/2.
void BiasFilter::scale(int by) noexcept {
  coarser_ = narrow<uint8_t>(coarser_ + by);
  const auto halve = [by](int32_t& x) { x = by > 0 ? (x + 1) >> 1 : x * 2; };
  for (int i = 0; i < kRows; ++i) {
    // The last of each is a square of the unit.
    for (int times = i < kPose ? 1 : 2; times > 0; --times) {
      halve(of_bias_[i]);
      halve(of_change_[i]);
      if (i == kBias) halve(change_);
    }
  }
}

void BiasFilter::forget() noexcept {
  for (int i = 0; i < kPose; ++i) of_bias_[i] = of_change_[i] = 0;
}

BiasFilter::Covariance BiasFilter::step(int32_t x, int32_t y, Duration elapsed, bool by_gyro) noexcept {
  Covariance grows{};
  if (!begun()) return grows;
  // The pose moves by the bias that was.
  const int32_t ms = elapsed.raw();
  const int32_t turned_for = by_gyro ? ms : 0;
  const int32_t turns = turned_for << coarser_;
  const int32_t bias = of_bias_[kBias];
  const auto drag = [x, y](int32_t(&with)[kRows], int64_t turned) {
    with[kX] = saturating_add(with[kX], -product(y, with[kHeading]));
    with[kY] = saturating_add(with[kY], product(x, with[kHeading]));
    with[kHeading] = saturating_add(with[kHeading], -turned);
  };
  grows.heading = over(-int64_t{of_bias_[kHeading]}, turns, 8000) +
                  over(int64_t{bias} * turned_for, turned_for, 256000000 >> (2 * coarser_));
  drag(of_bias_, over(bias, turns, 16000));
  drag(of_change_, over(of_change_[kBias], turns, 16000));
  grows.x_heading = over(-int64_t{of_bias_[kX]}, turns, 16000);
  grows.y_heading = over(-int64_t{of_bias_[kY]}, turns, 16000);
  // Then the bias changes.
  for (int i = 0; i < kRows; ++i) of_bias_[i] = saturating_add(of_bias_[i], over(of_change_[i], ms, 64000));
  of_change_[kBias] = saturating_add(of_change_[kBias], over(change_, ms, 64000));
  const int64_t wanders = over(kWanders, ms, INT32_C(1000) << (2 * coarser_));
  of_bias_[kBias] = saturating_add(of_bias_[kBias], over(of_change_[kBias], ms, 64000) + wanders);
  change_ = saturating_add(change_, over(kChangeWanders, ms, INT32_C(1000) << (2 * coarser_)));
  rescale(0);
  return grows;
}

BiasFilter::Learned BiasFilter::measure(int32_t off, int64_t variance, Covariance& shrinks) noexcept {
  rescale(variance);
  int32_t& bias = of_bias_[kBias];
  if ((square(off) / kSurprise) >> (2 * coarser_) > int64_t{bias} + in_unit(variance)) {
    rescale(square(off));
    bias = saturating_add(bias, in_unit(square(off)));
  }
  const int32_t noise = in_unit(variance);
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
  const auto ahead = [&](int32_t with_bias) { return saturate32(over(with_bias, off, both << coarser_)); };
  learned.ahead = {ahead(with[kX]), ahead(with[kY]), ahead(with[kHeading])};

  change_ = saturating_add(change_, -share(mixed, mixed));
  if (change_ < 0) change_ = 0;
  for (int i = 0; i < kRows; ++i) {
    of_change_[i] = saturating_add(of_change_[i], -share(of_bias_[i], mixed));
    of_bias_[i] = saturate32(share(of_bias_[i], noise));
  }
  if (bias < 1) bias = 1;
  rescale(0);
  return learned;
}

void BiasFilter::correct_heading(int64_t share, int64_t x, int64_t y) noexcept {
  const int64_t by[kPose] = {x, y, share * 16};
  for (int i = 0; i < kPose; ++i) {
    of_bias_[i] = saturating_add(of_bias_[i], -product(by[i], of_bias_[kHeading]));
    of_change_[i] = saturating_add(of_change_[i], -product(by[i], of_change_[kHeading]));
  }
}

}  // namespace whisker::localization
