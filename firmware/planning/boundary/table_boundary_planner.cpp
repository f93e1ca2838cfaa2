#include "firmware/planning/boundary/table_boundary_planner.hpp"

#include "firmware/planning/ground_inputs.hpp"

namespace whisker::planning {
namespace {

// The look ahead is shorter than a step of the thesis planner, and repeated at every reading.
constexpr Q14 kOfBaseTurn = Q14::ratio(1, 2);

}  // namespace

Angle TableDeflection::deflect(const View& view, Angle course, const Params& params,
                               Decision& decision) noexcept {
  decision.inputs =
      ground_inputs(perception::nearest(view.moving_scan), *view.local_grid, view.pose.at, course, params);
  decision.response = engine_(decision.inputs);
  if (params.boundary.bend == Fitted::no) return {};
  return scaled(derived::kBaseTurn, kOfBaseTurn * decision.response.turn);
}

}  // namespace whisker::planning
