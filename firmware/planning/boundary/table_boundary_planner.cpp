#include "firmware/planning/boundary/table_boundary_planner.hpp"

#include "firmware/fuzzy/scale.hpp"

namespace whisker::planning {

Angle TableDeflection::deflect(const perception::Echoes& sight, const Params& params,
                               Decision& decision) noexcept {
  decision.inputs = fuzzy::scale(sight.beam[hal::kLeft].distance, sight.beam[hal::kFront].distance,
                                 sight.beam[hal::kRight].distance, params.rangefinders.max_range);
  decision.response = engine_(decision.inputs);
  if (params.boundary.bend == Fitted::no) return {};
  return scaled(derived::kBaseTurn, decision.response.turn);
}

}  // namespace whisker::planning
