#include "host/lab/calibration/drive_rig.hpp"

#include <cmath>

#include "host/harness/run/sim_world.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/bearing.hpp"
#include "host/harness/sim/random.hpp"
#include "host/harness/sim/sim_board.hpp"

namespace whisker::calibration {
namespace {

constexpr std::uint32_t kErrorStream = 0xCA11;
constexpr std::uint32_t kSceneStream = 0xCA12;
constexpr double kLongest_s = 600;

double si(Length length) { return length.raw() * 1e-6; }

Noise of_each_run(Noise noise) {
  noise.wheel_scale_sigma = noise.wheel_scale_common_sigma = noise.gyro_scale_sigma = 0;
  noise.fix_every_m = 0;
  return noise;
}

}  // namespace

WheelErrors draw(const WheelErrorSigmas& s, std::uint64_t seed) {
  sim::Random random(seed, kErrorStream);
  const double left = s.wheel * random.normal(), right = s.wheel * random.normal();
  WheelErrors e;
  e.wheel_ratio = (1 + right) / (1 + left);
  e.counts_per_m = 1 - (left + right) / 2 + s.common * random.normal();
  e.track = 1 + s.track * random.normal();
  e.gyro_scale = 1 + s.gyro_scale * random.normal();
  return e;
}

double true_value(const Params& believed, const WheelErrors& e, Quantity quantity) {
  const double value = value_in(believed, quantity);
  switch (quantity) {
    case Quantity::gyro_scale: return value * e.gyro_scale;
    case Quantity::wheel_ratio: return value * e.wheel_ratio;
    case Quantity::counts_per_metre: return value * e.counts_per_m;
    case Quantity::track: return value * e.track;
  }
  return 0;
}

const char* name(Scene scene) {
  switch (scene) {
    case Scene::discs: return "discs";
    case Scene::wall: return "wall";
    case Scene::room: return "room";
  }
  return "?";
}

Scenario scene(Scene kind, const Params& params, std::uint64_t seed) {
  sim::Random random(seed, kSceneStream);
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  const double radius = si(params.body.radius), near = radius + 0.15;
  Scenario s;
  s.name = name(kind);
  const double turned = between(-sim::kPi, sim::kPi);
  const auto rotated = [&](double x, double y) {
    return sim::Vec2{x * std::cos(turned) - y * std::sin(turned),
                     x * std::sin(turned) + y * std::cos(turned)};
  };
  switch (kind) {
    case Scene::discs:
      for (int i = 0; i < 8; ++i) {
        const double r = between(0.03, 0.15), d = between(near + r, 1.5), at = between(-sim::kPi, sim::kPi);
        s.discs.push_back({{d * std::cos(at), d * std::sin(at)}, r});
      }
      break;
    case Scene::wall: {
      const double d = between(near, 0.6);
      s.walls.push_back({rotated(d, -between(0.5, 3)), rotated(d, between(0.5, 3))});
      break;
    }
    case Scene::room: {
      const double left = between(near, 1.5), right = between(near, 1.5);
      const double ahead = between(near, 2), behind = between(near, 2);
      s.walls.push_back({rotated(ahead, left), rotated(-behind, left), rotated(-behind, -right),
                         rotated(ahead, -right), rotated(ahead, left)});
      break;
    }
  }
  return s;
}

DriveRig::DriveRig(const Params& believed, const Sensor& sensor, const Noise& noise,
                   const WheelErrors& errors, std::uint64_t seed)
    : believed_(believed), sensor_(sensor), noise_(of_each_run(noise)), errors_(errors), seed_(seed) {}

Ended DriveRig::spin(const Scenario& world, planning::SpinPlanner& planner) {
  return run(
      world, planner, [&] { return planner.trouble(); }, nullptr);
}

Ended DriveRig::straight(planning::StraightPlanner& planner, const Scenario& world) {
  return run(
      world, planner, [&] { return planner.trouble(); }, nullptr);
}

Ended DriveRig::square(planning::SquarePlanner& planner, SquareEnd& end, const Scenario& world) {
  return run(
      world, planner, [&] { return planner.trouble(); }, &end);
}

Ended DriveRig::run(const Scenario& world, planning::Planner& planner, const Told& trouble, SquareEnd* end) {
  Scenario scenario = world;
  scenario.robot = believed_;
  scenario.sensor = sensor_;
  const SimWorld sim_world(scenario);
  sim::RobotSpec spec = robot_spec(scenario);
  spec.counts_per_m *= errors_.counts_per_m;
  spec.wheel_ratio *= errors_.wheel_ratio;
  spec.track *= errors_.track;
  spec.gyro_range *= believed_.gyro.scale.raw() * 1e-6 * errors_.gyro_scale;
  spec.gyro_dies_s = gyro_dies_s_;
  sim::Plant plant(sim_world.view(), spec, noise_spec(noise_), seed_++, {});
  hal::SimBoard board(plant);
  Robot robot(board, board, planner, believed_, &board, &board);
  robot.place({});
  robot.set_goal({{1_m, 0_m}, 100_mm});
  Ended ended;
  for (std::uint32_t now = 0;; now += static_cast<std::uint32_t>(believed_.safety.period.raw())) {
    const Status& status = robot.tick(Time::from_raw(now));
    ended.time_s = now * 1e-3;
    if (status.health.fault != Fault::none) ended.trouble = whisker::name(status.health.fault);
    const bool over = status.decision.outcome != planning::Outcome::running;
    if (over && trouble() != planning::Trouble::none) ended.trouble = planning::name(trouble());
    if (plant.in_contact()) ended.trouble = "contact";
    if (!over && ended.time_s > kLongest_s) ended.trouble = "time_limit";
    if (!ended.good() || over) break;
    plant.advance();
  }
  const sim::Pose& pose = plant.pose();
  distance_m_ = pose.at.x;
  if (end != nullptr) {
    const Pose& believed = robot.status().pose;
    *end = {end->left, pose.at.x, pose.at.y, si(believed.at.x), si(believed.at.y)};
  }
  return ended;
}

}  // namespace whisker::calibration
