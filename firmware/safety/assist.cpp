#include "firmware/safety/assist.hpp"

#include "firmware/fuzzy/response_table.hpp"
#include "firmware/planning/ground_inputs.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::safety {

Assist::Assist() noexcept : table_(&fuzzy::kResponseTable) {}

planning::VelocityRequest Assist::step(const planning::VelocityRequest& asked, Speed fastest,
                                       const Pose& pose, const perception::LocalGrid& grid,
                                       const Params& params) noexcept {
  active_ = false;
  response_ = {};
  if (!asked.moves || asked.forward <= Speed{}) return asked;
  response_ = fuzzy::Bilinear(*table_)(planning::near_inputs(grid, pose, params));

  planning::VelocityRequest bent = asked;
  constexpr Q14 kAll = Q14::ratio(1, 1);
  if (response_.step < kAll) bent.forward = max(Speed{}, asked.forward * response_.step);
  const Speed most = min(fastest, planning::kFastestTurn * (params.body.track / 2));
  const Speed top = params.wheels.max_speed;
  const Speed pace = Speed::from_raw(multiply_divide(most.raw(), min(asked.forward, top).raw(), top.raw()));
  bent.turning = limit(asked.turning + pace * response_.turn, max(abs(asked.turning), fastest));
  active_ = bent.forward != asked.forward || bent.turning != asked.turning;
  return bent;
}

}  // namespace whisker::safety
