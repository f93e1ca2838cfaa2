#include "firmware/planning/candidate_headings.hpp"

namespace whisker::planning {

Way way(const View& view, Angle heading, Length length, Length reach) noexcept {
  const perception::Obstacles o = view.local_grid->along(view.pose.at, heading, length, reach, 1);
  if (o.suspect > 0) return Way::occupied;
  return o.unknown > 0 ? Way::unknown : Way::free;
}

namespace {

/// Direction from straight ahead in which the axis of the beam passes at this distance from the centre.
Angle axis_through(const Params& params, int beam, Length far) noexcept {
  const Mount m = mount(params.rangefinders, beam);
  if (m.apex == Vec{}) return m.axis;
  const Length off = across(m.apex, m.axis);
  return abs(off) >= far ? m.axis : m.axis - arc_sine(off, far);
}

}  // namespace

Unseen unseen(const View& view, Angle heading, Length length, Angle from, const Params& params) noexcept {
  const perception::Obstacles o =
      view.local_grid->along(view.pose.at, heading, length, view.local_grid->reach().planning, 1);
  if (o.suspect > 0 || o.unknown == 0) return {};
  const Angle front = bearing(o.nearest_unknown) - from;
  const Length far = norm(o.nearest_unknown);
  Angle turn = front - axis_through(params, hal::kFront, far);
  for (int beam = hal::kLeft; beam <= hal::kRight; beam += hal::kRight - hal::kLeft) {
    const Angle other = front - axis_through(params, beam, far);
    if (magnitude(other) < magnitude(turn)) turn = other;
  }
  return {o.unknown, turn};
}

}  // namespace whisker::planning
