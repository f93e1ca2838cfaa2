#include "firmware/localization/pose_bound.hpp"

namespace whisker::localization {
namespace {

constexpr int64_t kMostVariance = INT64_C(1) << 48;  // um^2: kMost
constexpr int64_t kMostHeading = INT64_C(1) << 41;   // 2 rad^2
constexpr int64_t kMostMixed = INT64_C(1) << 41;
constexpr int64_t kMostGathered = INT64_C(1) << 38;  // so that times kMost it has 62 bits
constexpr int32_t kMostMove = INT32_C(1) << 20;      // um in one update
constexpr int32_t kLongest = INT16_MAX;              // ms in one update: far longer than a gyro is trusted
// Rounding of the counts and of the instants of readings.
constexpr int64_t kFloor = INT64_C(3000) * 3000;   // um^2
constexpr int64_t kRounding = 64;                  // of the mean of samples, (rad/s)^2 2^-48
constexpr int64_t kRadianUnit = INT64_C(1) << 20;  // of a heading
constexpr int64_t kTurnPerRadian = 683565276;      // 2^-32 turn

static_assert(int64_t{PoseBound::kMost.raw()} * PoseBound::kMost.raw() <= kMostVariance);

int64_t limited(int64_t x, int64_t most) noexcept { return x > most ? most : x < -most ? -most : x; }

Length root(int64_t variance) noexcept {
  const int64_t inside = variance < 0 ? 0 : variance;
  const Length sigma = Length::from_raw(as_signed(square_root(static_cast<uint64_t>(inside))));
  return min(sigma, PoseBound::kMost);
}

Length length_of(int64_t um) noexcept { return Length::from_raw(saturate32(um)); }

/// Rounding may take more of a variance than it has.
int64_t not_negative(int64_t variance) noexcept { return variance < 0 ? 0 : variance; }

/// The square of an angle in 2^-32 turn, over a divisor.
int32_t squared_over(Angle angle, int32_t divisor) noexcept {
  return saturate32(divide_rounded(square(angle.wrapped()), divisor));
}

struct GyroNoise {
  int32_t walk_per_ms;  // 2^-56 rad^2
  int64_t rounding;     // of a mean of samples at rest, (rad/s)^2 2^-48
};

/// Samples with less noise than half their unit are all rounded to the same side while the body rests, and to
/// either side while it turns.
GyroNoise noise_of(const Params& params) noexcept {
  const int32_t walk = squared_over(params.pose_error.gyro_walk, 23344401);
  const int32_t rate = params.gyro.rate_hz;
  const int64_t unit = square(rate_of(65536, params.gyro));
  if (int64_t{walk} * rate * 1000 / 256 >= unit / 4) return {walk, kRounding};
  return {walk + narrow<int32_t>(unit * 256 / (INT64_C(12000) * rate)), unit / 4};
}

/// Of a mean of samples, (rad/s)^2 2^-48.
int64_t variance(const GyroNoise& noise, Duration lasted) noexcept {
  return divide_rounded(int64_t{noise.walk_per_ms} * 3906250, lasted.raw()) / 1000 + noise.rounding;
}

}  // namespace

Length distance_bound(const PoseSigma& sigma) noexcept { return norm({sigma.along, sigma.across}) * 2; }

void PoseBound::configure(const Params& params) noexcept {
  const PoseErrorParams& e = params.pose_error;
  known_ = declares_errors(e);
  um_per_counts_ = narrow<int32_t>(divide_rounded(INT64_C(500000) << 16, params.wheels.counts_per_metre));
  // Errors of two wheels: their mean is off by 1 / sqrt(2) of one, their difference by sqrt(2).
  const int64_t both = 2 * square(e.wheel_scale_common.raw()) + square(e.wheel_scale.raw());
  const uint32_t twice = square_root(static_cast<uint64_t>(both) << 20);
  scale_ = narrow<int32_t>(quotient(twice * INT64_C(741455), 1000000));
  turn_per_um_ =
      narrow<int32_t>(divide_rounded(e.wheel_scale.raw() * INT64_C(24879108), params.body.track.raw()));
  gyro_scale_ = multiply_divide(e.gyro_scale.raw(), INT32_C(1) << 30, 1000000);
  // In ten minutes: 2 pi 2^30 / 2^32 / 600.
  bias_.configure(multiply_divide(e.gyro_warm_up.wrapped(), 2617994, 1000000000));
  walk_per_um_ = squared_over(e.heading_drift, 6484556);
  walk_per_ms_ = noise_of(params).walk_per_ms;
}

void PoseBound::set_difference(Ratio sigma, Length track) noexcept {
  // 2^44 / 1e6
  const int64_t taught = divide_rounded(sigma.raw() * INT64_C(17592186), track.raw());
  if (taught < turn_per_um_) turn_per_um_ = narrow<int32_t>(taught);
}

bool PoseBound::correct_heading(Angle ahead, Angle sigma, Correction& out) noexcept {
  const auto radians = [](Angle a) { return divide_rounded(a.wrapped() * kRadianUnit, kTurnPerRadian); };
  const int64_t off = radians(ahead);
  const int64_t noise = limited(square(radians(sigma)), kMostHeading) + 1;
  const int64_t both = limited(heading_variance(), kMostHeading) + noise;
  if (square(off) > square(kJumpSigmas) * both) return false;
  gather();
  // um per radian
  const int64_t x = limited(quotient_64(x_heading_ * kRadianUnit, both), kMost.raw());
  const int64_t y = limited(quotient_64(y_heading_ * kRadianUnit, both), kMost.raw());
  out.shift = {length_of(scale_down<20>(x * off)), length_of(scale_down<20>(y * off))};
  const int64_t share = quotient_64(heading_ << 16, both);
  out.turn = Angle::from_raw(static_cast<uint32_t>(scale_down<16>(ahead.wrapped() * share)));
  xx_ -= scale_down<20>(x * x_heading_);
  xy_ -= scale_down<20>(x * y_heading_);
  yy_ -= scale_down<20>(y * y_heading_);
  bias_.correct_heading(share, x, y);
  const int64_t rest = 65536 - share;
  x_heading_ = scale_down<16>(x_heading_ * rest);
  y_heading_ = scale_down<16>(y_heading_ * rest);
  heading_ = scale_down<16>(heading_ * rest);
  return true;
}

PoseBound::Correction PoseBound::rest(const GyroBias::Mean& mean, const Params& params,
                                      GyroBias& bias) noexcept {
  const int64_t noise = variance(noise_of(params), mean.lasted);
  if (mean.first) {
    bias_.begin(noise);
    return {};
  }
  BiasFilter::Covariance shrinks{};
  const BiasFilter::Learned learned = bias_.measure(mean.off_rad, noise, shrinks);
  bias.learn(mean.off, learned.bias, learned.change);
  if (known_) {
    heading_ = not_negative(heading_ - shrinks.heading);
    x_heading_ -= shrinks.x_heading;
    y_heading_ -= shrinks.y_heading;
    xx_ = not_negative(xx_ - shrinks.xx);
    xy_ -= shrinks.xy;
    yy_ = not_negative(yy_ - shrinks.yy);
  }
  const int64_t turn = scale_down<20>(learned.ahead.heading * kTurnPerRadian);
  return {{length_of(learned.ahead.x), length_of(learned.ahead.y)},
          Angle::from_raw(static_cast<uint32_t>(turn))};
}

/// All that turns the pose becomes part of the walk: a measured heading ties these errors together.
void PoseBound::gather() noexcept {
  for (Lasting& error : lasting_) {
    if (error.heading == 0) continue;
    heading_ += scale_down<16>(square(error.heading));
    x_heading_ += scale_down<12>(signed_product(error.x, error.heading));
    y_heading_ += scale_down<12>(signed_product(error.y, error.heading));
    xx_ += scale_down<8>(square(error.x));
    xy_ += scale_down<8>(signed_product(error.x, error.y));
    yy_ += scale_down<8>(square(error.y));
    error = {};
  }
  heading_ = limited(heading_, kMostHeading);
  x_heading_ = limited(x_heading_, kMostGathered);
  y_heading_ = limited(y_heading_, kMostGathered);
}

void PoseBound::restart(const Pose& pose, const PoseSigma& sigma) noexcept {
  for (Lasting& error : lasting_) error = {};
  bias_.forget();
  shortened_ = {};
  // Not the ticks, however often this is called: the bias of the gyro wanders on.
  last_ = pose;
  counts_ = 0;
  const int64_t heading = divide_rounded(int64_t{sigma.heading.wrapped()} << 20, kTurnPerRadian);
  heading_ = limited(square(heading), kMostHeading);
  x_heading_ = y_heading_ = 0;
  const int64_t c = cos(pose.heading).raw() >> 16;  // 2^-14
  const int64_t s = sin(pose.heading).raw() >> 16;
  const int64_t along = square(min(sigma.along, kMost).raw());
  const int64_t across = square(min(sigma.across, kMost).raw());
  xx_ = scale_down<14>(c * scale_down<14>(c * along) + s * scale_down<14>(s * across));
  yy_ = along + across - xx_;
  xy_ = scale_down<14>(c * scale_down<14>(s * (along - across)));
}

bool PoseBound::step(const Step& step) noexcept {
  counts_ += step.counts.left + step.counts.right;
  elapsed_ms_ = narrow<uint16_t>(limited(int64_t{elapsed_ms_} + step.elapsed.raw(), kLongest));
  if (++ticks_ < kEvery) return false;
  const bool moved = !(step.pose.at == last_.at && step.pose.heading == last_.heading);
  update(step, moved);
  last_ = step.pose;
  counts_ = 0;
  elapsed_ms_ = 0;
  ticks_ = 0;
  return moved && known_;
}

void PoseBound::update(const Step& step, bool moved) noexcept {
  const Vec way = step.pose.at - last_.at;
  const int32_t x = narrow<int32_t>(limited(way.x.raw(), kMostMove));
  const int32_t y = narrow<int32_t>(limited(way.y.raw(), kMostMove));
  const BiasFilter::Covariance grows = bias_.step(x, y, milliseconds(elapsed_ms_), step.by_gyro && moved);
  if (!moved || !known_) return;
  const int64_t turned = scale_down<16>(signed_product((step.pose.heading - last_.heading).wrapped(), 25736));
  const int64_t forward = scale_down<16>(signed_product(counts_, um_per_counts_));
  int64_t by[kLastings] = {};
  if (step.by_gyro) {
    by[kGyroScale] = scale_down<30>(turned * gyro_scale_);
  } else {
    by[kScale] = scale_down<30>(turned * scale_);
    by[kDifference] = scale_down<16>(forward * turn_per_um_);
  }
  for (int i = 0; i < kLastings; ++i) {
    Lasting& error = lasting_[i];
    const int64_t heading = error.heading + by[i] / 2;
    error.x = saturating_add(error.x, -scale_down<24>(y * heading));
    error.y = saturating_add(error.y, scale_down<24>(x * heading));
    error.heading = saturating_add(error.heading, by[i]);
  }
  Lasting& scale = lasting_[kScale];
  scale.x = saturating_add(scale.x, scale_down<26>(signed_product(x, scale_)));
  scale.y = saturating_add(scale.y, scale_down<26>(signed_product(y, scale_)));

  const int64_t walked =
      step.by_gyro ? int64_t{walk_per_ms_} * elapsed_ms_ : (forward < 0 ? -forward : forward) * walk_per_um_;
  walk(x, y, scale_down<16>(walked) + grows.heading);
  x_heading_ = limited(x_heading_ + grows.x_heading, kMostMixed);
  y_heading_ = limited(y_heading_ + grows.y_heading, kMostMixed);
  shorten(x, y);
}

/// A heading that is off by a makes the way shorter by a^2 / 2 along itself. Its root mean square is sqrt(3)
/// / 2 of the variance.
void PoseBound::shorten(int32_t x, int32_t y) noexcept {
  const int64_t share = limited(heading_variance(), kMostHeading) * 887 / 1024;  // 2^-40
  shortened_.x = saturating_add(shortened_.x, scale_down<36>(x * share));
  shortened_.y = saturating_add(shortened_.y, scale_down<36>(y * share));
}

int64_t PoseBound::heading_variance() const noexcept {
  int64_t sum = heading_;
  for (const Lasting& error : lasting_) sum += scale_down<16>(square(error.heading));
  return not_negative(sum);
}

void PoseBound::walk(int32_t x, int32_t y, int64_t by) noexcept {
  const int64_t x_by = scale_down<20>(-y * heading_);
  const int64_t y_by = scale_down<20>(x * heading_);
  xx_ = limited(xx_ - scale_down<20>(y * x_heading_ * 2) - scale_down<20>(y * x_by), kMostVariance);
  yy_ = limited(yy_ + scale_down<20>(x * y_heading_ * 2) + scale_down<20>(x * y_by), kMostVariance);
  xy_ = limited(xy_ + scale_down<20>(x * x_heading_ - y * y_heading_) + scale_down<20>(x * x_by),
                kMostVariance);
  x_heading_ = limited(x_heading_ + x_by, kMostMixed);
  y_heading_ = limited(y_heading_ + y_by, kMostMixed);
  heading_ = limited(heading_ + by, kMostHeading);
}

PoseSigma PoseBound::sigma() const noexcept {
  int64_t xx = xx_ + kFloor;
  int64_t xy = xy_;
  int64_t yy = yy_ + kFloor;
  const auto add = [&](const Place& error) {
    xx += scale_down<8>(square(error.x));
    xy += scale_down<8>(signed_product(error.x, error.y));
    yy += scale_down<8>(square(error.y));
  };
  for (const Lasting& error : lasting_) add(error);
  add(shortened_);
  if (xx > kMostVariance || yy > kMostVariance) {
    xx = yy = kMostVariance;
    xy = 0;
  }
  xy = limited(xy, kMostVariance);
  const int64_t c = cos(last_.heading).raw() >> 16;  // 2^-14
  const int64_t s = sin(last_.heading).raw() >> 16;
  const int64_t along = scale_down<14>(c * scale_down<14>(c * xx + s * xy)) +
                        scale_down<14>(s * scale_down<14>(c * xy + s * yy));
  const uint64_t radians =
      square_root(static_cast<uint64_t>(limited(heading_variance(), kMostHeading)));  // 2^-20
  const uint64_t turn = radians * kTurnPerRadian >> 20;
  constexpr uint64_t kMostTurn = UINT64_C(1) << 30;
  return {root(along), root(xx + yy - along),
          Angle::from_raw(static_cast<uint32_t>(turn < kMostTurn ? turn : kMostTurn))};
}

}  // namespace whisker::localization
