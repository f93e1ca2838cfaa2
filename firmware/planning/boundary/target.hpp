/// The goal as seen from the body.
#pragma once

#include "firmware/math/trig.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

/// Where the goal lies, seen from the body.
struct Target {
  Target() = default;
  Target(const Goal& goal, const View& view) noexcept : to(goal.at - view.pose.at), distance(norm(to)) {}
  Angle direction() const noexcept { return bearing(to); }

  Vec to;
  Length distance;
};

}  // namespace whisker::planning
