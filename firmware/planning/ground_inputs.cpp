#include "firmware/planning/ground_inputs.hpp"

#include "firmware/fuzzy/scale.hpp"

namespace whisker::planning {
namespace {

// Radii of the body.
constexpr int32_t kHorizon = 4;
constexpr int32_t kNearHorizon = 2;

}  // namespace

fuzzy::Inputs ground_inputs(Length nearest, const perception::LocalGrid& grid, Vec at, Angle course,
                            const Params& params) noexcept {
  const perception::Ways free = grid.ways(at, course, params.body.radius * kHorizon);
  return fuzzy::scale(free.left, min(nearest, free.nearest), free.right, params.body.radius * kSight);
}

fuzzy::Inputs near_inputs(const perception::LocalGrid& grid, const Pose& pose,
                          const Params& params) noexcept {
  const Length horizon = params.body.radius * kNearHorizon;
  const perception::Ways free = grid.ways(pose.at, pose.heading, horizon);
  return fuzzy::scale(free.left, free.ahead, free.right, horizon);
}

}  // namespace whisker::planning
