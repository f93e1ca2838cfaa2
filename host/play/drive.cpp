#include "host/play/drive.hpp"

#include "host/run/spec.hpp"

namespace whisker::play {
namespace {

constexpr double kNotedEvery = 0.005;  // m

}  // namespace

Drive::Drive(const Scenario& scenario, PlannerKind planner, const fuzzy::Engine::Table& table)
    : scenario_(scenario),
      world_(std::make_unique<SimWorld>(scenario_)),
      view_(world_->view()),
      plant_(view_, robot_spec(scenario_), noise_spec(scenario_.noise), scenario_.seed, scenario_.start),
      pilot_(scenario_, make_core_planner(planner, scenario_.robot, table), plant_),
      run_(scenario_, plant_, pilot_),
      map_(scenario_.robot),
      map_bytes_(planner.map_bytes),
      way_{{scenario_.start.at, report::Doing::free}} {
  run_.decide();
  map_.look(run_.guide());
}

void Drive::advance(int ticks) {
  for (; ticks > 0 && !run_.verdict(); --ticks) {
    run_.move();
    if (!run_.verdict()) run_.decide();
    map_.look(run_.guide());
    note();
  }
}

void Drive::change(const Scenario& scenario) {
  const bool new_goal = scenario.goal.at.x != scenario_.goal.at.x ||
                        scenario.goal.at.y != scenario_.goal.at.y ||
                        scenario.goal.tolerance_m != scenario_.goal.tolerance_m;
  scenario_.goal = scenario.goal;
  scenario_.bounds = scenario.bounds;
  scenario_.discs = scenario.discs;
  scenario_.polygons = scenario.polygons;
  scenario_.walls = scenario.walls;
  scenario_.movers = scenario.movers;
  world_ = std::make_unique<SimWorld>(scenario_);
  view_ = world_->view();
  if (!new_goal && !run_.verdict()) return;
  pilot_.set_goal(fixed_goal(scenario_.goal));
  run_.resume();
}

void Drive::note() {
  const TickRecord r = run_.record();
  const sim::Vec2 at{r.x_m, r.y_m};
  const sim::Vec2 step = at - way_.back().at;
  const double square = sim::dot(step, step);
  const report::Doing doing = report::doing(r);
  const bool far = square >= kNotedEvery * kNotedEvery;
  if (far || (square > 0 && doing != way_.back().doing)) way_.push_back({at, doing});
}

}  // namespace whisker::play
