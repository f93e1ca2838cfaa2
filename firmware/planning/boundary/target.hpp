/// The goal relative to the body.
#pragma once

#include "firmware/math/trig.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

/// Vector from the body to the goal.
struct Target {
  Target() = default;
  Target(const Goal& goal, const View& view) noexcept : to(goal.at - view.pose.at), distance(norm(to)) {}
  Angle direction() const noexcept { return bearing(to); }

  Vec to;
  Length distance;
};

}  // namespace whisker::planning
