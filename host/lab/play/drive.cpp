#include "host/lab/play/drive.hpp"

#include "host/harness/run/spec.hpp"
#include "host/lab/report/track.hpp"

namespace whisker::play {

Drive::Drive(const Scenario& scenario, PlannerKind planner, const fuzzy::Engine::Table& table)
    : scenario_(scenario),
      world_(std::make_unique<SimWorld>(scenario_)),
      view_(world_->view()),
      plant_(view_, robot_spec(scenario_), noise_spec(scenario_.noise), scenario_.seed, scenario_.start),
      pilot_(scenario_, make_core_planner(planner, scenario_.robot, table), plant_),
      run_(scenario_, plant_, pilot_),
      map_(scenario_.robot),
      map_bytes_(planner.map_bytes) {
  note(scenario_.start.at, static_cast<int>(report::Doing::free));
  run_.decide();
  map_.look(run_.guide());
}

void Drive::advance(int ticks) {
  for (; ticks > 0 && !over(); --ticks) {
    run_.move();
    if (!over()) run_.decide();
    map_.look(run_.guide());
    const TickRecord r = run_.record();
    note({r.x_m, r.y_m}, static_cast<int>(report::doing(r)));
  }
}

void Drive::change(const Scenario& scenario) {
  const bool new_goal = scenario.goal.at.x != scenario_.goal.at.x ||
                        scenario.goal.at.y != scenario_.goal.at.y ||
                        scenario.goal.tolerance_m != scenario_.goal.tolerance_m;
  adopt_world(scenario_, scenario);
  world_ = std::make_unique<SimWorld>(scenario_);
  view_ = world_->view();
  if (!new_goal && !over()) return;
  pilot_.set_goal(fixed_goal(scenario_.goal));
  run_.resume();
}

}  // namespace whisker::play
