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
  reach_ = params.body.radius + params.body.margin;
  for (int i = 0; i < hal::kBeams; ++i) {
    const Mount m = mount(params.rangefinders, i);
    const Angle left = m.axis + m.half_cone;
    const Angle right = m.axis - m.half_cone;
    const Length off_left = max(Length{}, across(m.apex, left));
    const Length off_right = max(Length{}, -across(m.apex, right));
    beam_[i] = {};
    if (off_left >= params.body.radius || off_right >= params.body.radius) continue;
    const uint32_t lost_left = arc_sine(off_left, params.body.radius).raw() / 2;
    const uint32_t lost_right = arc_sine(off_right, params.body.radius).raw() / 2;
    if (lost_left + lost_right >= m.half_cone.raw()) continue;
    beam_[i].axis = m.axis + Angle::from_raw(lost_right - lost_left);
    beam_[i].half = m.half_cone.raw() - lost_left - lost_right;
    beam_[i].ahead = min(along(m.apex, left), along(m.apex, right));
  }
}

void Surroundings::forget() noexcept {
  for (uint16_t& mm : free_mm_) mm = kUnknown;
}

void Surroundings::add(const perception::Echoes& look, Angle heading) noexcept {
  for (int i = 0; i < hal::kBeams; ++i) {
    const perception::Echo& echo = look.beam[i];
    if (!perception::usable(echo.validity)) continue;
    const Angle axis = heading + beam_[i].axis;
    const uint16_t mm = proved_mm(echo, beam_[i].ahead);
    for (int s = 0; s < kSectors; ++s) {
      const bool inside = magnitude(middle(s) - axis) + kHalfWidth <= beam_[i].half;
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
