#include "firmware/planning/steering.hpp"

namespace whisker::planning {
namespace {

constexpr Angle kFacing = 3_deg;
constexpr int32_t kFaceGain = 5;
constexpr int32_t kSteerGain = 6;
constexpr int64_t kMicroradians = 6283185;  // a turn

/// The highest rim speed of a turn that stops within the error.
Speed turn_speed(Angle error, const Params& params) noexcept {
  return approach_speed(abs(arc(error, params.body.track / 2)), params);
}

}  // namespace

Angle nearest_facing(Angle wanted, const Params& params) noexcept {
  const Angle count = angle_of(millimetres(1000) / params.wheels.counts_per_metre, params.body.track);
  const uint32_t resolution = count.raw() / 8 * 9;
  return resolution > wanted.raw() ? Angle::from_raw(resolution) : wanted;
}

AngularRate rate_towards(Angle error, int32_t gain) noexcept {
  const int64_t microradians = scale_down<32>(error.wrapped() * kMicroradians);
  return limit(AngularRate::from_raw(saturate32(microradians * gain)), kFastestTurn);
}

Speed stopping_speed(Length rest, Duration delay, const Params& params) noexcept {
  if (rest <= Length{}) return Speed{};
  const int64_t a = params.wheels.max_acceleration.raw();
  const int64_t lead = (params.wheels.max_acceleration * delay).raw();
  const uint32_t root = square_root(static_cast<uint64_t>(lead * lead + 2 * a * rest.raw()));
  return Speed::from_raw(saturate32(static_cast<int64_t>(root) - lead));
}

Speed approach_speed(Length rest, const Params& params) noexcept {
  return stopping_speed(rest, derived::settle_time(params), params);
}

Manoeuvre cruise(Twist twist, const Params& params) noexcept {
  Manoeuvre m;
  m.kind = ManoeuvreKind::cruise;
  m.forward = twist.forward;
  m.turning = twist.turning * (params.body.track / 2);
  return m;
}

Manoeuvre steer(Angle error, Speed top, const Params& params) noexcept {
  const int64_t off = scale_down<32>(magnitude(error) * kMicroradians);
  const int64_t part = 1000000 - quotient(off * 6, 5);
  const Speed forward = part <= 0 ? Speed{} : top * Q15::ratio(static_cast<int32_t>(part), 1000000);
  Manoeuvre m = cruise({forward, rate_towards(error, kSteerGain)}, params);
  // An eighth more than stops within the error: while the body drives, the error is corrected continuously.
  m.turning = limit(m.turning, turn_speed(error, params) * 9 / 8);
  return m;
}

Manoeuvre face(Angle error, const Params& params) noexcept {
  Manoeuvre m = cruise({Speed{}, rate_towards(error, kFaceGain)}, params);
  m.turning = limit(m.turning, turn_speed(error, params));
  return m;
}

bool turn_by(Angle error, const Params& params, Manoeuvre& manoeuvre) noexcept {
  manoeuvre = face(error, params);
  return magnitude(error) < nearest_facing(kFacing, params).raw();
}

}  // namespace whisker::planning
