#include "tests/perception/rig.hpp"

#include "host/harness/run/planners.hpp"
#include "host/harness/run/spec.hpp"

namespace whisker::test {

Rig::Rig(const Scenario& scenario, planning::Planner* planner)
    : scenario_(scenario),
      world_(scenario_),
      plant_(world_.view(), robot_spec(scenario_), noise_spec(scenario_.noise), scenario_.seed,
             scenario_.start),
      board_(plant_),
      own_(planner == nullptr ? make_planner(PlannerKind::boundary, scenario_.robot) : nullptr),
      recording_(planner == nullptr ? *own_ : *planner),
      robot_(board_, board_, recording_, scenario_.robot, &board_) {
  robot_.place(fixed_pose(scenario_.start));
  robot_.set_goal(
      {fixed_pose({scenario_.goal.at, 0}).at, fixed_pose({{scenario_.goal.tolerance_m, 0}, 0}).at.x});
}

bool Rig::step() {
  const Status& status = robot_.tick(Time::from_raw(now_ms_));
  now_ms_ += static_cast<std::uint32_t>(scenario_.robot.safety.period.raw());
  if (status.health.fault != Fault::none || status.decision.outcome != planning::Outcome::running)
    return false;
  plant_.advance();
  return !plant_.in_contact();
}

}  // namespace whisker::test
