#include "host/cli/test_drives.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "firmware/planning/goal_planner.hpp"
#include "host/run/runner.hpp"
#include "host/worlds/generate.hpp"

namespace whisker::cli {
namespace {

constexpr double kReferenceRadius = 0.09;  // m
constexpr int kDiscs = 15;

double metres(Length l) { return l.raw() * 1e-6; }

Scenario empty_world() {
  Scenario s;
  s.start = {{0, 0}, 0};
  s.goal.at = {3.5, 0.8};
  return s;
}

/// half_width: of the corridor.
Scenario corridor(double half_width) {
  Scenario s;
  s.start = {{0, 0}, 0};
  s.goal.at = {3.5, 0.05};
  for (const double y : {half_width, -half_width}) s.walls.push_back({{-0.5, y}, {4.5, y}});
  return s;
}

Scenario discs() {
  worlds::Options options;
  options.discs = kDiscs;
  return worlds::generate(worlds::Kind::discs, options);
}

void scale(sim::Vec2& v, double by) { v = {v.x * by, v.y * by}; }

/// Scales the scenario from the reference robot to this robot.
Scenario fitted(Scenario s, const Params& params, const Sensor& sensor) {
  const double by = metres(params.body.radius) / kReferenceRadius;
  scale(s.start.at, by);
  scale(s.goal.at, by);
  for (sim::Disc& d : s.discs) scale(d.center, by), d.radius *= by;
  for (auto& wall : s.walls) {
    for (sim::Vec2& p : wall) scale(p, by);
  }
  s.goal.tolerance_m = std::max(
      s.goal.tolerance_m * by,
      std::max(2 * metres(params.motion.drive_tolerance), metres(planning::smallest_tolerance(params))));
  const sim::Vec2 way = s.goal.at - s.start.at;
  s.time_limit_s = 600 + 40 * std::sqrt(sim::dot(way, way)) / (params.wheels.max_speed.raw() * 1e-6);
  s.noise = {};
  s.sensor = sensor;
  s.robot = params;
  return s;
}

}  // namespace

std::vector<TestDrive> test_drives(const Params& params, const Sensor& sensor, PlannerKind planner) {
  const double wide = 2.8 * (1 + metres(params.skirt.planning_margin) / metres(params.body.radius));
  const std::pair<const char*, Scenario> worlds[] = {
      {"the empty world", empty_world()},
      {"the corridor", corridor(wide * kReferenceRadius)},
      {"the field of discs", discs()},
  };
  RunOptions options;
  options.planner = planner;
  std::vector<TestDrive> drives;
  for (const auto& [name, scenario] : worlds) {
    drives.push_back({name, run(fitted(scenario, params, sensor), options)});
  }
  return drives;
}

}  // namespace whisker::cli
