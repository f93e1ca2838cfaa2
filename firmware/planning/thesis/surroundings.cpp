#include "firmware/planning/thesis/surroundings.hpp"

#include "firmware/planning/thesis/near_way.hpp"

namespace whisker::planning {
namespace {

constexpr int32_t kUmPerMm = 1000;
constexpr Angle kWidth = Angle::turns(1, Surroundings::kSectors);
constexpr Length kRounding = 1_mm;  // more than the rounding of a point by its angle
constexpr uint32_t kHalfWidth = kWidth.raw() / 2;

constexpr Angle middle(int sector) noexcept { return kWidth * sector + Angle::from_raw(kHalfWidth); }

/// A clear beam is unlimited, as in Probe: no step exceeds the maximum range.
uint16_t proved_mm(const perception::Echo& echo, Length ahead) noexcept {
  const int32_t mm = (echo.distance + ahead).raw() / kUmPerMm;
  const bool far = echo.validity == perception::Validity::clear || mm > int32_t{UINT16_MAX};
  return far ? UINT16_MAX : static_cast<uint16_t>(mm);
}

}  // namespace

// A cone whose apex is ahead of the centre covers less of the circle. A direction counts as covered if the
// ray from the centre is inside the cone where it leaves the body.
void Surroundings::configure(const Params& params) noexcept {
  const RangefinderParams& r = params.rangefinders;
  const Angle half_cone = Angle::from_raw(r.cone.raw() / 2);
  const Length across = r.offset * sin(half_cone);
  reach_ = params.body.radius + params.body.margin;
  side_ = r.side_angle;
  ahead_ = r.offset * cos(half_cone);
  half_ = 0;
  if (across >= params.body.radius) return;
  const int64_t radius = params.body.radius.raw();
  const int64_t along =
      square_root(static_cast<uint64_t>(radius * radius - int64_t{across.raw()} * across.raw()));
  const Angle lost = atan2(across.raw(), saturate32(along));
  if (lost.raw() < half_cone.raw()) half_ = (half_cone - lost).raw();
}

void Surroundings::forget() noexcept {
  for (uint16_t& mm : free_mm_) mm = kUnknown;
}

void Surroundings::add(const perception::Echoes& look, Angle heading) noexcept {
  for (int i = 0; i < hal::kBeams; ++i) {
    const perception::Echo& echo = look.beam[i];
    if (!perception::usable(echo.validity)) continue;
    const Angle axis = heading + beam_axis(side_, i);
    const uint16_t mm = proved_mm(echo, ahead_);
    for (int s = 0; s < kSectors; ++s) {
      const bool inside = magnitude(middle(s) - axis) + kHalfWidth <= half_;
      if (inside && mm > free_mm_[s]) free_mm_[s] = mm;
    }
  }
}

bool Surroundings::allow(Angle heading, Length step) const noexcept {
  constexpr uint32_t kFlank = Angle::turns(1, 4).raw();
  for (int s = 0; s < kSectors; ++s) {
    if (free_mm_[s] == kUnknown) continue;
    const uint32_t away = magnitude(middle(s) - heading);
    const uint32_t nearest = away > kHalfWidth ? away - kHalfWidth : 0;
    if (nearest >= kFlank) continue;
    const Length free = millimetres(free_mm_[s]);
    if (free >= step + reach_ + kRounding) continue;
    const Angle aside = Angle::from_raw(nearest);
    const Length beside = free * sin(aside);
    if (beside >= reach_) continue;
    if (near_way({free * cos(aside), beside}, step, reach_)) return false;
  }
  return true;
}

}  // namespace whisker::planning
