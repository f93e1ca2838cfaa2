#include "host/harness/run/event_pilot.hpp"

namespace whisker {

std::unique_ptr<Pilot> core_pilot(const Scenario& scenario, PlannerKind planner, sim::Plant& plant) {
  if (!scenario.events.empty()) return std::make_unique<EventPilot>(scenario, planner, plant);
  return std::make_unique<CorePilot>(scenario, make_recorded_planner(planner, scenario.robot), plant);
}

}  // namespace whisker
