#include <fmt/core.h>

#include "host/harness/run/fix_source.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/worlds/generate.hpp"
#include "tests/golden/stream.hpp"

namespace whisker::golden {
namespace {

/// The largest map that fits into every target.
constexpr PlannerKind kLargestMapOfAll = core_planner("map", 8192);

/// Drives with the core in this process, and records its inputs.
class RecordingPilot final : public Pilot {
 public:
  RecordingPilot(const Scenario& scenario, PlannerKind planner, sim::Plant& plant, Bytes& to)
      : pilot_(core_pilot(scenario, planner, plant)), plant_(plant), fixes_(scenario), to_(to) {
    append_params(to, scenario.robot);
    append_begin(to, planner, fixed_pose(scenario.start));
    append_goal(to, fixed_goal(scenario.goal));
  }
  const Status& tick(Time now) override {
    append_tick(to_, plant_, now);
    if (const auto fix = fixes_.take(plant_)) append_fix(to_, *fix);
    return pilot_->tick(now);
  }

 private:
  std::unique_ptr<Pilot> pilot_;
  sim::Plant& plant_;
  FixSource fixes_;
  Bytes& to_;
};

Stream drive(const std::string& world, Scenario scenario, PlannerKind planner, double seconds) {
  Stream stream{fmt::format("{} {}", name(planner), world), {}, 0};
  scenario.time_limit_s = seconds;
  RunOptions options;
  options.planner = planner;
  options.pilot = [&](const Scenario& s, PlannerKind kind, sim::Plant& plant) {
    return std::make_unique<RecordingPilot>(s, kind, plant, stream.messages);
  };
  stream.hash = run(scenario, options).hash;
  return stream;
}

Scenario from_file(const std::string& name) {
  return load_scenario(std::string(WHISKER_SOURCE_DIR) + "/" + name + ".toml");
}

Scenario generated(worlds::Kind kind, bool noise, std::uint64_t seed = 1) {
  worlds::Options options;
  options.seed = seed;
  options.noise = noise;
  return worlds::generate(kind, options);
}

/// The gyro rests after a minute. Of no planner's streams: budgets are without a gyro.
Stream gyro_drive() {
  Scenario scenario = generated(worlds::Kind::rooms, true);
  apply_robot_file(scenario, std::string(WHISKER_SOURCE_DIR) + "/host/robots/gyro.toml");
  scenario.robot.pose_error.wheel_scale = millionths(10000);
  scenario.robot.walls.straight = Fitted::yes;
  scenario.noise.fix_every_m = 4;
  scenario.robot.safety.period = 20_ms;
  Stream stream = drive("rooms, gyro and fixes", scenario, PlannerKind::boundary, 66);
  stream.name = "with " + stream.name;
  return stream;
}

}  // namespace

std::vector<Stream> drives() {
  std::vector<Stream> all;
  for (const PlannerKind planner : {PlannerKind::boundary, PlannerKind::thesis}) {
    const auto add = [&](const char* world, const Scenario& scenario, double seconds) {
      all.push_back(drive(world, scenario, planner, seconds));
    };
    add("U-trap", from_file("host/worlds/scenarios/figure8_u_trap"), 12);
    add("discs", generated(worlds::Kind::discs, false), 10);
    add("maze with noise", generated(worlds::Kind::maze, true), 6);
    add("all noise", from_file("tests/cli/scenarios/all_noise"), 4);
    add("crossing mover", from_file("tests/cli/scenarios/crossing_mover"), 3);
    add("large fast robot", from_file("tests/cli/scenarios/large_fast_robot"), 3);
    add("small slow robot", from_file("tests/cli/scenarios/small_slow_robot"), 3);
  }
  all.push_back(drive("spiral", generated(worlds::Kind::spiral, false), PlannerKind::boundary, 6));
  all.push_back(drive("enclosed", generated(worlds::Kind::enclosed, false), PlannerKind::boundary, 6));
  for (const PlannerKind planner : {PlannerKind::map, kLargestMapOfAll}) {
    all.push_back(drive("U-trap", from_file("host/worlds/scenarios/figure8_u_trap"), planner, 12));
    all.push_back(drive("maze with noise", generated(worlds::Kind::maze, true), planner, 6));
    all.push_back(drive("maze", generated(worlds::Kind::maze, false, 3), planner, 4));
  }
  all.push_back(drive("enclosed", generated(worlds::Kind::enclosed, false), PlannerKind::map, 6));
  all.push_back(
      drive("crossing mover", from_file("tests/cli/scenarios/crossing_mover"), PlannerKind::map, 3));
  all.push_back(
      drive("large fast robot", from_file("tests/cli/scenarios/large_fast_robot"), PlannerKind::map, 3));
  all.push_back(gyro_drive());
  return all;
}

}  // namespace whisker::golden
