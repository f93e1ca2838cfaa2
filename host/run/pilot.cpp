#include "host/run/core_pilot.hpp"

namespace whisker {

std::unique_ptr<Pilot> core_pilot(const Scenario& scenario, PlannerKind planner, sim::Plant& plant) {
  auto pilot = std::make_unique<CorePilot>(scenario, make_recorded_planner(planner, scenario.robot), plant);
  pilot->start_anew_with(planner);
  return pilot;
}

}  // namespace whisker
