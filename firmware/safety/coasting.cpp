#include "firmware/safety/coasting.hpp"

namespace whisker::safety {
namespace {

constexpr int32_t kOne = 65536;
constexpr int32_t kLags = 5;           // after so many, the rest is one piece
constexpr int32_t kPiecesALag = 2;     // of a way that is divided by 1
constexpr int32_t kFinest = 8;         // divisor
constexpr int32_t kBendOfPieces = 12;  // a way divided by n is nearer to the true one, by this times n^2

Speed faster(WheelPair w) noexcept { return max(abs(w.left), abs(w.right)); }

int32_t microseconds(Duration d) noexcept { return d.raw() * 1000; }

}  // namespace

int64_t Arc::turn(Length track) const noexcept {
  constexpr int64_t kRadian = 683565276;  // 2^32 / 2 pi
  return divide_rounded((right - left).raw() * kRadian, track.raw());
}

Coasting::Coasting(WheelPair command, const WheelState& wheels, const Params& params, Length allowed) noexcept
    : command_(command),
      rolling_(wheels.rolling),
      lag_us_(microseconds(params.wheels.motor_lag)),
      hold_us_(microseconds(longest_gap(params))),
      braking_us_(multiply_divide(faster(command).raw(), 1000000, params.wheels.max_acceleration.raw())) {
  const int32_t parts = divisor(params.body.track, allowed);
  if (parts == 0) return;
  left_ = kLags * kPiecesALag * parts + 1;
  step_us_ = lag_us_ / (kPiecesALag * parts);
  fades_ = 2 * kOne / (2 * kPiecesALag * parts + 1);  // by the trapezoidal rule
}

/// 0: one arc is near enough.
int32_t Coasting::divisor(Length track, Length allowed) const noexcept {
  if (lag_us_ == 0) return 0;
  const int64_t bend = bend_um(track);
  if (bend <= allowed.raw() && overshoot() <= allowed) return 0;
  int32_t parts = 1;
  while (parts < kFinest && bend > int64_t{allowed.raw()} * kBendOfPieces * parts * parts) ++parts;
  return parts;
}

/// The most that the way is off one arc. Two ways over the same times of rolling and following differ, by
/// Green's theorem, by the curl of the motion times the area between them, here at most half the rectangle.
int64_t Coasting::bend_um(Length track) const noexcept {
  const auto area = [](Speed a, Speed b) { return signed_product(a.raw() / 256, b.raw() / 256); };
  const int64_t curl = area(rolling_.right, command_.left) - area(rolling_.left, command_.right);
  if (curl == 0) return 0;
  const int64_t um_per_s2 = quotient((curl < 0 ? -curl : curl) * 65536, track.raw());
  const int64_t um_per_s = quotient(um_per_s2 * lag_us_, 1000000);
  return quotient(um_per_s * (hold_us_ + braking_us_ / 2), 2000000);
}

/// How far it rolls on before it goes the other way.
Length Coasting::overshoot() const noexcept {
  const int32_t rolls = rolling_.left.raw() + rolling_.right.raw();
  const int32_t asked = command_.left.raw() + command_.right.raw();
  if ((rolls < 0) == (asked < 0)) return {};
  return Length::from_raw(multiply_divide(rolls < 0 ? -rolls : rolls, lag_us_, 2000000));
}

/// Of the command, as a share of itself, us.
int64_t Coasting::speed_integral(int32_t until_us) const noexcept {
  if (until_us <= hold_us_) return until_us;
  const int64_t braked = until_us - hold_us_ < braking_us_ ? until_us - hold_us_ : braking_us_;
  return hold_us_ + braked - (braked == 0 ? 0 : quotient(braked * braked, braking_us_) / 2);
}

bool Coasting::next(Arc& piece) noexcept {
  if (left_ == 0) return false;
  --left_;
  const int32_t then_us = left_ == 0 ? INT32_MAX : now_us_ + step_us_;
  const int64_t asked = speed_integral(then_us) - speed_integral(now_us_);
  int32_t rolls = 0, follows = 0;
  if (left_ != 0) {
    const int32_t mean = narrow<int32_t>(quotient(asked * kOne, step_us_));
    rolls = rolls_ - multiply_divide(rolls_, fades_, kOne);
    follows = follows_ + multiply_divide(mean - follows_, fades_, kOne);
  }
  // What has not followed yet does so later.
  const int64_t rolled = scale_down<16>(int64_t{lag_us_} * (rolls_ - rolls));
  const int64_t followed = asked - scale_down<16>(int64_t{lag_us_} * (follows - follows_));
  const auto way = [&](Speed rolling, Speed command) {
    const int64_t um = divide_rounded(rolling.raw() * rolled + command.raw() * followed, 1000000);
    return Length::from_raw(saturate32(um));
  };
  piece = {way(rolling_.left, command_.left), way(rolling_.right, command_.right)};
  now_us_ = then_us;
  rolls_ = rolls;
  follows_ = follows;
  return true;
}

}  // namespace whisker::safety
