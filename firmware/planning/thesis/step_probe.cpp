#include "firmware/planning/thesis/step_probe.hpp"

#include "firmware/planning/thesis/near_way.hpp"

namespace whisker::planning {

void StepProbe::configure(const Params& params) noexcept {
  reach_ = params.body.radius + params.body.margin;
  for (int i = 0; i < hal::kBeams; ++i) {
    const Mount m = mount(params.rangefinders, i);
    const uint32_t aside = magnitude(m.axis);
    const uint32_t half = m.half_cone.raw();
    const bool left = m.axis == Angle{} ? m.apex.y >= Length{} : m.axis.wrapped() > 0;
    const Angle inner = Angle::from_raw(aside > half ? aside - half : 0);
    const Angle beyond = Angle::from_raw(half > aside ? half - aside : 0);
    beam_[i] = {{m.apex.x, left ? m.apex.y : -m.apex.y}, cos(inner), sin(inner), sin(beyond)};
  }
}

bool StepProbe::free(const perception::Echoes& look, Length step) const noexcept {
  for (int i = 0; i < hal::kBeams; ++i) {
    const perception::Echo& echo = look.beam[i];
    if (!perception::usable(echo.validity)) return false;
    if (echo.validity == perception::Validity::clear) continue;
    const Inner& b = beam_[i];
    const Length aside = b.apex.y + echo.distance * b.sin - echo.distance * b.beyond;
    const Vec nearest{b.apex.x + echo.distance * b.cos, max(Length{}, aside)};
    if (near_way(nearest, step, reach_)) return false;
  }
  return true;
}

}  // namespace whisker::planning
