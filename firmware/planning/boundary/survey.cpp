#include "firmware/planning/boundary/survey.hpp"

#include "firmware/planning/steering.hpp"

namespace whisker::planning {
namespace {

constexpr Angle kSide = 50_deg;  // with the outer edges of the cones, covers 92 degrees to each side

}  // namespace

bool Survey::step(const View& view, Angle target, const Params& params, Manoeuvre& manoeuvre) noexcept {
  const Angle heading = target + (sides_ == 0 ? kSide : -kSide);
  return turn_by(heading - view.pose.heading, params, manoeuvre) && ++sides_ == 2;
}

}  // namespace whisker::planning
