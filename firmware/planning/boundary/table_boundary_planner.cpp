#include "firmware/planning/boundary/table_boundary_planner.hpp"

#include "firmware/planning/ground_inputs.hpp"

namespace whisker::planning {
namespace {

// Per unit of SA. The look ahead is shorter than a step of the thesis planner, and repeated at every reading;
// where the ground may hold what no beam shows, distance is worth more than the way.
constexpr Angle kBend = 4_deg;
constexpr Angle kBendInDoubt = 8_deg;

}  // namespace

Angle TableDeflection::deflect(const View& view, Angle course, const Params& params,
                               Decision& decision) noexcept {
  decision.inputs =
      ground_inputs(perception::nearest(view.moving_scan), *view.local_grid, view.pose.at, course, params);
  decision.response = engine_(decision.inputs);
  if (params.boundary.bend == Fitted::no) return {};
  return scaled(view.doubts ? kBendInDoubt : kBend, decision.response.turn);
}

}  // namespace whisker::planning
