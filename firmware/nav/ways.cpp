#include "firmware/nav/ways.hpp"

namespace whisker::nav {

Way way(const View& view, Angle heading, Length length, Length reach) noexcept {
  const ground::Obstacles o = view.patch->along(view.pose.at, heading, length, reach, 1);
  if (o.suspect > 0) return Way::blocked;
  return o.unknown > 0 ? Way::open : Way::free;
}

bool turn_to_unseen(const View& view, Angle heading, Length length, Angle from, const Params& params,
                    Angle& turn) noexcept {
  const ground::Obstacles o =
      view.patch->along(view.pose.at, heading, length, view.patch->reach().planning, 1);
  if (o.suspect > 0 || o.unknown == 0) return false;
  const Angle front = bearing(o.nearest_unknown) - from;
  const Angle side = params.rangefinders.side_angle;
  turn = front;
  if (magnitude(front - side) < magnitude(turn)) turn = front - side;
  if (magnitude(front + side) < magnitude(turn)) turn = front + side;
  return true;
}

}  // namespace whisker::nav
