#include "host/harness/run/runner.hpp"

#include "host/harness/run/mission_run.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/run/spec.hpp"

namespace whisker {

RunResult run(const Scenario& file, const RunOptions& options) {
  Scenario scenario = file;  // its goal follows the events
  EventPlayer events(scenario.events);
  const SimWorld world(scenario);
  sim::Plant plant(world.view(), robot_spec(scenario), noise_spec(scenario.noise),
                   options.seed.value_or(scenario.seed), scenario.start);
  const std::unique_ptr<Pilot> pilot = options.pilot(scenario, options.planner, plant);
  MissionRun mission(scenario, plant, *pilot);

  const auto ticks_a_second = 1000 / static_cast<std::uint64_t>(scenario.robot.safety.period.raw());
  const auto record = [&] {
    if (options.watch)
      options.watch({mission.record(), mission.status().health, pilot->local_grid(), pilot->guide()});
  };
  const auto play = [&] {
    while (pilot->hears()) {
      const Event* const event = events.next(mission.next_time());
      if (event == nullptr) break;
      const bool played = pilot->play(*event);
      events.count(played);
      if (played && event->kind == EventKind::goal) scenario.goal = event->goal;
    }
    mission.await_mission(!pilot->hears() ||
                          events.to_come({EventKind::goal, EventKind::restart}, scenario.time_limit_s));
  };
  while (!mission.verdict()) {
    if (!events.empty()) play();
    mission.decide();
    record();
    if (mission.verdict()) break;
    const double t_s = mission.time();
    mission.move();
    if (mission.verdict()) record();
    if (options.progress && (mission.ticks() - 1) % ticks_a_second == 0)
      options.progress(t_s, mission.distance_left());
  }
  RunResult result = mission.result();
  if (!events.empty()) result.events = events.counted();
  return result;
}

}  // namespace whisker
