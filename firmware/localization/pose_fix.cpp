#include "firmware/localization/pose_fix.hpp"

namespace whisker::localization {
namespace {

/// The difference of two values, and their standard deviations: lengths in 2^4 um, angles in 2^-24 turn.
struct Difference {
  int32_t size;
  int32_t estimate;
  int32_t fix;
};
struct Differences {
  Difference along, across, heading;
};

Difference of(Length size, Length estimate, Length fix) noexcept {
  const auto scaled = [](Length x) { return min(x, PoseBound::kMost).raw() / 16; };
  return {size.raw() / 16, scaled(estimate), scaled(fix)};
}

Differences differences(const UncertainPose& estimate, const UncertainPose& fix) noexcept {
  const Vec way = fix.pose.at - estimate.pose.at;
  const Angle ahead = estimate.pose.heading;
  const auto part = [](Angle a) { return a.wrapped() / 256; };
  return {of(along(way, ahead), estimate.sigma.along, fix.sigma.along),
          of(along(way, ahead + Angle::turns(1, 4)), estimate.sigma.across, fix.sigma.across),
          {part(fix.pose.heading - ahead), part(estimate.sigma.heading), part(fix.sigma.heading)}};
}

bool too_far(const Difference& d) noexcept {
  return square(d.size) > square(PoseBound::kJumpSigmas) * (square(d.estimate) + square(d.fix));
}

/// The weight of the fix, 2^-16: its share of the inverse variances.
int32_t weight(const Difference& d) noexcept {
  const int64_t both = square(d.estimate) + square(d.fix);
  return both == 0 ? 65536 : narrow<int32_t>(quotient_64(square(d.estimate) << 16, both));
}

/// The standard deviation of the mean, in the unit of the fix's.
int32_t remaining(int32_t fix, int32_t weight) noexcept {
  return narrow<int32_t>(int64_t{fix} * square_root(uint64_t{narrow<uint32_t>(weight)} << 16) >> 16);
}

}  // namespace

PoseSigma sound(const PoseSigma& sigma) noexcept {
  const auto limited = [](Length x) { return x < Length{} ? PoseBound::kMost : min(x, PoseBound::kMost); };
  constexpr Angle kMostHeading = Angle::turns(1, 4);
  return {limited(sigma.along), limited(sigma.across),
          sigma.heading.raw() > kMostHeading.raw() ? kMostHeading : sigma.heading};
}

bool jumps(const UncertainPose& estimate, const UncertainPose& fix) noexcept {
  const Differences d = differences(estimate, fix);
  return too_far(d.along) || too_far(d.across) || too_far(d.heading);
}

UncertainPose fused(const UncertainPose& estimate, const UncertainPose& fix) noexcept {
  const Differences d = differences(estimate, fix);
  const int32_t along = weight(d.along);
  const int32_t across = weight(d.across);
  const int32_t heading = weight(d.heading);
  const Vec way = fix.pose.at - estimate.pose.at;
  const Angle ahead = estimate.pose.heading;
  const auto part = [](int32_t x, int32_t weight) { return saturate32(scale_down<16>(int64_t{x} * weight)); };
  const auto step = [&](Angle direction, int32_t weight) {
    return polar(direction, Length::from_raw(part(whisker::along(way, direction).raw(), weight)));
  };
  const int32_t turn = part((fix.pose.heading - ahead).wrapped(), heading);
  return {{estimate.pose.at + step(ahead, along) + step(ahead + Angle::turns(1, 4), across),
           ahead + Angle::from_raw(static_cast<uint32_t>(turn))},
          {Length::from_raw(remaining(fix.sigma.along.raw(), along)),
           Length::from_raw(remaining(fix.sigma.across.raw(), across)),
           Angle::from_raw(static_cast<uint32_t>(remaining(fix.sigma.heading.wrapped(), heading)))}};
}

}  // namespace whisker::localization
