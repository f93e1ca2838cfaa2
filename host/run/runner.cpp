#include "host/run/runner.hpp"

#include "host/run/sim_world.hpp"
#include "host/run/spec.hpp"
#include "host/run/trip.hpp"

namespace whisker {

RunResult run(const Scenario& scenario, const RunOptions& options) {
  const SimWorld world(scenario);
  sim::Plant plant(world.view(), sim::robot_spec(scenario.robot), noise_spec(scenario.noise),
                   options.seed.value_or(scenario.seed), scenario.start);
  const std::unique_ptr<Pilot> pilot = options.pilot(scenario, options.planner, plant);
  Trip trip(scenario, plant, *pilot);

  const auto ticks_a_second = 1000 / static_cast<std::uint64_t>(scenario.robot.safety.period.raw());
  const auto record = [&] {
    if (options.records == nullptr && !options.observe && !options.watch) return;
    const TickRecord r = trip.record();
    if (options.records != nullptr) options.records->push_back(r);
    if (options.observe) options.observe(r);
    if (options.watch) options.watch({r, trip.status().health, pilot->local_grid(), pilot->guide()});
  };
  while (!trip.verdict()) {
    trip.decide();
    record();
    if (trip.verdict()) break;
    const double t_s = trip.time();
    trip.move();
    if (trip.verdict()) record();
    if (options.progress && (trip.ticks() - 1) % ticks_a_second == 0)
      options.progress(t_s, trip.distance_left());
  }
  return trip.result();
}

}  // namespace whisker
