#include "firmware/planning/boundary/survey.hpp"

#include "firmware/planning/steering.hpp"

namespace whisker::planning {
namespace {

constexpr Angle kSide = 50_deg;  // with the outer edges of the cones, covers 92 degrees to each side
constexpr Angle kFlank = 92_deg;

}  // namespace

bool Survey::step(const View& view, Angle target, const Params& params, Manoeuvre& manoeuvre) noexcept {
  const Angle past = view.local_grid->reach().past;
  const Angle outer = mount(params.rangefinders, sides_ == 0 ? hal::kLeft : hal::kRight).axis;
  const Angle swept = kFlank + past - Angle::from_raw(magnitude(outer));
  const Angle side = past != Angle{} && swept.wrapped() > kSide.wrapped() ? swept : kSide;
  const Angle heading = target + (sides_ == 0 ? side : -side);
  return turn_by(heading - view.pose.heading, params, manoeuvre) && ++sides_ == 2;
}

}  // namespace whisker::planning
