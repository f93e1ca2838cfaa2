#include "host/calibration/trials.hpp"

#include "host/run/spec.hpp"
#include "host/scenario/bearing.hpp"
#include "host/scenario/params_text.hpp"
#include "host/worlds/random.hpp"

namespace whisker::calibration {
Trial random_trial(const Noise& noise, double phantom, double along_m, std::uint64_t seed) {
  worlds::Random random(seed);
  Trial t;
  t.seed = seed;
  t.wall_m = random.uniform(0.25, 0.4);
  Params p;
  const double cone = random.uniform(10, 40);
  set_si(p.rangefinders.cone, cone);
  const double side[hal::kBeams] = {random.uniform(25, 60), random.uniform(-5, 5), random.uniform(-60, -25)};
  for (int i = 0; i < hal::kBeams; ++i) {
    BeamParams& beam = p.rangefinders.beams[i];
    set_si(beam.x, random.uniform(0.01, 0.07));
    set_si(beam.y, random.uniform(-0.05, 0.05));
    set_si(beam.angle, side[i]);
  }
  Sensor sensor;
  sensor.incidence_deg = random.uniform(25, 75);
  sensor.phantom = phantom;
  t.scenario = wall_scenario(p, sensor, noise, t.wall_m);
  t.robot = robot_spec(t.scenario);
  for (sim::BeamSpec& beam : t.robot.beams) beam.angle += random.uniform(-8, 8) * kRadPerDeg;
  t.along_m = along_m;
  if (along_m > 0) t.scenario.start.heading = random.uniform(-5, 5) * kRadPerDeg;
  return t;
}

TrialResult run(const Trial& trial) {
  TrialResult r;
  const Params& p = trial.scenario.robot;
  r.measured = calibrate(simulated_spin(trial.scenario, p, trial.robot, trial.seed, trial.along_m), p, 0);
  for (int i = 0; i < hal::kBeams; ++i) {
    r.truth[static_cast<std::size_t>(i)] = truth(trial.robot, i, trial.wall_m);
  }
  if (r.measured.complete()) {
    const Params written = advise(r.measured, p).params;
    r.written_incidence_deg = written.rangefinders.incidence.wrapped() * (180.0 / 2147483648.0);
  }
  return r;
}

}  // namespace whisker::calibration
