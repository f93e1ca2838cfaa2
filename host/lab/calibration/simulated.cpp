#include "host/lab/calibration/simulated.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/localization/odometry.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/bearing.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/sim/plant.hpp"
#include "host/harness/worlds/random.hpp"
#include "host/lab/calibration/sample.hpp"
#include "host/lab/calibration/spin.hpp"

namespace whisker::calibration {
namespace {

constexpr double kHalfWall = 20;  // m: its ends are out of every range

TickRecord record(const sim::Plant& plant, const Pose& believed, hal::WheelSpeeds command) {
  TickRecord r;
  r.t_s = plant.time();
  r.x_m = plant.pose().at.x;
  r.y_m = plant.pose().at.y;
  r.heading_rad = plant.pose().heading;
  r.ranges = plant.ranges();
  r.v_left_mps = plant.v_left();
  r.v_right_mps = plant.v_right();
  r.command = command;
  r.est_x_m = believed.at.x.raw() * 1e-6;
  r.est_y_m = believed.at.y.raw() * 1e-6;
  r.est_heading_rad = radians(believed.heading);
  return r;
}

}  // namespace

Scenario wall_scenario(const Params& params, const Sensor& sensor, const Noise& noise, double wall_m) {
  Scenario s;
  s.name = "wall";
  s.robot = params;
  s.sensor = sensor;
  s.noise = noise;
  s.walls = {{{wall_m, -kHalfWall}, {wall_m, kHalfWall}}};
  return s;
}

double usual_distance_m(const Params& params, const Sensor& sensor) {
  const double radius = params.body.radius.raw() * 1e-6;
  double apex = 0, nearest = sensor.min_range_m.value_or(0), farthest = sensor.max_range_m.value_or(1000);
  for (int i = 0; i < hal::kBeams; ++i) {
    const Believed b = believed(params, i);
    apex = std::max(apex, std::hypot(b.x_m, b.y_m));
    nearest = std::max(nearest, b.min_range_m);
    farthest = std::min(farthest, b.max_range_m);
  }
  const double least = std::max(radius + 0.05, apex + 1.2 * nearest);
  return std::max(least, std::min(std::max(0.3, 1.5 * radius), 0.5 * farthest));
}

Sweep simulated_spin(const Scenario& scenario, const Params& believed, const sim::RobotSpec& what,
                     std::uint64_t seed, double along_m, RunLog* log) {
  const SimWorld world(scenario);
  sim::Plant plant(world.view(), what, noise_spec(scenario.noise), seed, scenario.start);
  localization::Odometry odometry;
  odometry.configure(believed);
  odometry.place({});
  Collector collector(believed);
  Spin spin(believed, along_m);
  const Duration period = believed.safety.period;
  while (!spin.done() && !spin.failed() && !plant.in_contact()) {
    localization::CountStep counts;
    odometry.update(plant.encoders(), period, counts);
    collector.add(plant.time(), odometry.pose(), plant.ranges());
    const hal::WheelSpeeds command =
        spin.step(collector.turned_rad(), collector.from_start_m(), plant.time());
    if (log != nullptr) log->add({record(plant, odometry.pose(), command), Health{}, nullptr});
    plant.command(command);
    plant.advance();
  }
  return collector.sweep();
}

Truth truth(const sim::RobotSpec& what, int beam, double wall_m) {
  const sim::BeamSpec& b = what.beams[beam];
  const auto half_cone = [&](double metres) {
    const double far = std::min(what.cone_far_half_width, b.cone_half_width);
    const double share = std::min(metres / what.taper_range, 1.0);
    return b.cone_half_width - (b.cone_half_width - far) * share;
  };
  const double incidence = std::min(what.incidence, 89 * kRadPerDeg);
  Truth t;
  t.axis_deg = b.angle / kRadPerDeg;
  t.half_cone_deg = half_cone(wall_m) / kRadPerDeg;
  t.incidence_deg = what.incidence / kRadPerDeg;
  t.edge_deg = t.incidence_deg + half_cone(wall_m / std::cos(incidence)) / kRadPerDeg;
  return t;
}

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
