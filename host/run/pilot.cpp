#include "host/run/pilot.hpp"

#include "hal/sim/sim_board.hpp"
#include "host/run/spec.hpp"

namespace whisker {
namespace {

class CorePilot final : public Pilot {
 public:
  CorePilot(const Scenario& scenario, PlannerKind planner, sim::Plant& plant)
      : board_(plant),
        planner_(make_planner(planner, scenario.robot)),
        robot_(board_, board_, *planner_, scenario.robot) {
    robot_.place(fixed_pose(scenario.start));
    robot_.set_goal(fixed_goal(scenario.goal));
  }
  const Status& tick(Time now) override { return robot_.tick(now); }

 private:
  hal::SimBoard board_;
  std::shared_ptr<nav::Planner> planner_;
  Robot robot_;
};

}  // namespace

std::unique_ptr<Pilot> core_pilot(const Scenario& scenario, PlannerKind planner, sim::Plant& plant) {
  return std::make_unique<CorePilot>(scenario, planner, plant);
}

nav::Goal fixed_goal(const Goal& goal) {
  return {fixed_pose({goal.at, 0}).at, fixed_pose({{goal.tolerance_m, 0}, 0}).at.x};
}

}  // namespace whisker
