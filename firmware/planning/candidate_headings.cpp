#include "firmware/planning/candidate_headings.hpp"

namespace whisker::planning {

Way way(const View& view, Angle heading, Length length, Length reach) noexcept {
  const perception::Obstacles o = view.local_grid->along(view.pose.at, heading, length, reach, 1);
  if (o.suspect > 0) return Way::occupied;
  return o.unknown > 0 ? Way::unknown : Way::free;
}

bool turn_to_unseen(const View& view, Angle heading, Length length, Angle from, const Params& params,
                    Angle& turn) noexcept {
  const perception::Obstacles o =
      view.local_grid->along(view.pose.at, heading, length, view.local_grid->reach().planning, 1);
  if (o.suspect > 0 || o.unknown == 0) return false;
  const Angle front = bearing(o.nearest_unknown) - from;
  const Angle side = params.rangefinders.side_angle;
  turn = front;
  if (magnitude(front - side) < magnitude(turn)) turn = front - side;
  if (magnitude(front + side) < magnitude(turn)) turn = front + side;
  return true;
}

}  // namespace whisker::planning
