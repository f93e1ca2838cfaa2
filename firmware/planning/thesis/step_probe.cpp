#include "firmware/planning/thesis/step_probe.hpp"

#include "firmware/planning/thesis/near_way.hpp"

namespace whisker::planning {

void StepProbe::configure(const Params& params) noexcept {
  const RangefinderParams& r = params.rangefinders;
  reach_ = params.body.radius + params.body.margin;
  const Vec apex = polar(r.side_angle, r.offset);
  side_apex_x_ = apex.x;
  side_apex_y_ = apex.y;
  front_apex_ = r.offset;
  const uint32_t half_cone = r.cone.raw() / 2;
  const bool overlaps_ahead = half_cone >= r.side_angle.raw();
  const Angle inner = overlaps_ahead ? Angle{} : r.side_angle - Angle::from_raw(half_cone);
  inner_cos_ = cos(inner);
  inner_sin_ = sin(inner);
}

bool StepProbe::free(const perception::Echoes& look, Length step) const noexcept {
  for (int i = 0; i < hal::kBeams; ++i) {
    const perception::Echo& echo = look.beam[i];
    if (!perception::usable(echo.validity)) return false;
    if (echo.validity == perception::Validity::clear) continue;
    const Vec nearest = i == hal::kFront ? Vec{front_apex_ + echo.distance, Length{}}
                                         : Vec{side_apex_x_ + echo.distance * inner_cos_,
                                               side_apex_y_ + echo.distance * inner_sin_};
    if (near_way(nearest, step, reach_)) return false;
  }
  return true;
}

}  // namespace whisker::planning
