#include "firmware/planning/boundary/behaviours.hpp"

namespace whisker::planning {

bool Behaviours::stalled(const View& view) noexcept { return stuck.stalled(view, patience(params), params); }

int32_t Behaviours::mm(Length reference) const noexcept { return for_body(params, reference).raw() / 1000; }

Manoeuvre Behaviours::drive(const View& view, Angle heading) const noexcept {
  return steer(heading - view.pose.heading, params.wheels.max_speed, params);
}

}  // namespace whisker::planning
