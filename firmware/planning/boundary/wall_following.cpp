#include "firmware/planning/boundary/wall_following.hpp"

#include "firmware/math/trig.hpp"

namespace whisker::planning {
namespace {

// All lengths are for the reference body; measured lengths are scaled to it.
constexpr Length kReference = 90_mm;
constexpr Length kWanted = 150_mm;
constexpr Length kTooFar = 60_mm;  // beyond the wanted distance: the wall ended
constexpr Length kTooNear = 100_mm;
constexpr int32_t kWallGain = 20;  // rad/s per metre
constexpr Length kAhead = 300_mm;
constexpr int32_t kAheadGain = 15;
constexpr Length kEndRadius = 180_mm;
constexpr AngularRate kHalts = 4000_mrad_per_s;  // at this turn rate the forward speed is zero

}  // namespace

Twist along_edge(const perception::Echoes& sight, Side wall, const Params& params) noexcept {
  const auto beside = [&](hal::Beam beam) {
    const Mount m = mount(params.rangefinders, beam);
    const Angle outwards = m.axis.wrapped() < 0 ? -m.axis : m.axis;
    return abs(m.apex.y) + sight.beam[beam].distance * sin(outwards + m.half_cone);
  };
  const Length left = beside(hal::kLeft);
  const Length right = beside(hal::kRight);
  const Length gap = wall == Side::left ? left : right;
  const auto reference = [&](Length l) {
    return Length::from_raw(multiply_divide(l.raw(), kReference.raw(), params.body.radius.raw()));
  };
  const Length wanted = min(kWanted, reference((left + right) / 2));
  const Length error = max(-kTooNear, min(reference(gap) - wanted, kTooFar));
  const Length ahead = max(Length{}, kAhead - reference(sight.beam[hal::kFront].distance));
  const AngularRate towards =
      limit(AngularRate::from_raw((error * kWallGain).raw() - (ahead * kAheadGain).raw()), kFastestTurn);
  const Speed top = params.wheels.max_speed;
  const bool ended = error == kTooFar && ahead == Length{};
  const Speed forward =
      ended ? min(top, abs(towards) * for_body(params, kEndRadius))
            : top - Speed::from_raw(multiply_divide(top.raw(), abs(towards).raw(), kHalts.raw()));
  return {forward, towards * sign(wall)};
}

}  // namespace whisker::planning
