#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "firmware/planning/goal_planner.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/run/planners.hpp"
#include "host/harness/run/record.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/mounting.hpp"
#include "host/harness/scenario/robot_header.hpp"
#include "host/harness/scenario/sensor.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/lab/report/result.hpp"
#include "host/lab/report/units.hpp"

namespace whisker::cli {
namespace {

struct TestDrive {
  std::string world;  ///< "the empty world", "the corridor", "the field of discs"
  RunResult result;
};

constexpr double kReferenceRadius = 0.09;  // m
constexpr int kDiscs = 15;

using report::metres;

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

/// With these sensors and no other noise, in worlds that scale with the body. The parameters must pass
/// check().
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
  ProgressLine line;
  for (const auto& [name, scenario] : worlds) {
    line.show(fmt::format("drives through {}", name));
    drives.push_back({name, run(fitted(scenario, params, sensor), options)});
  }
  return drives;
}

using Json = nlohmann::ordered_json;

struct RobotOptions {
  std::string file;
  std::string header;
  PlannerKind planner = kDefaultPlanner;
  bool json = false;
};

bool reached(const TestDrive& drive) { return drive.result.verdict == Verdict::reached; }

Json violations_json(const InputErrors& errors) {
  Json all = Json::array();
  for (const InputError& e : errors.all()) {
    all.push_back({{"line", e.line()}, {"column", e.column()}, {"text", e.what()}});
  }
  return all;
}

Json drives_json(const std::vector<TestDrive>& drives) {
  Json all = Json::array();
  for (const TestDrive& drive : drives) {
    Json one = Json::parse(report::result_json(drive.result));
    one["world"] = drive.world;
    all.push_back(one);
  }
  return all;
}

Json warnings_json(const std::vector<MountingWarning>& warnings) {
  Json all = Json::array();
  for (const MountingWarning& w : warnings) all.push_back({{"kind", w.kind}, {"text", w.text}});
  return all;
}

/// params: null if the parameters are invalid.
void print_json(const RobotOptions& o, const Params* params, const Json& violations,
                const std::vector<MountingWarning>& warnings, const std::vector<TestDrive>& drives) {
  const bool fit = params != nullptr && std::all_of(drives.begin(), drives.end(), reached);
  const Json json = {{"fit", fit},
                     {"violations", violations},
                     {"warnings", warnings_json(warnings)},
                     {"drives", drives_json(drives)}};
  Provenance provenance{{}, name(o.planner), o.file, {}, rules_name(o.planner)};
  if (params != nullptr) provenance.robot_digest = robot_digest(*params);
  print_object(json.dump(-1, ' ', false, Json::error_handler_t::replace), provenance);
}

int execute(const RobotOptions& o) {
  check_outputs({o.header}, {o.file}, o.json);
  std::FILE* const out = words_beside({o.header});
  Params params;
  Sensor sensor;
  try {
    apply_robot_file(params, sensor, o.file);
  } catch (const InputErrors& errors) {
    if (!o.json) throw;
    print_json(o, nullptr, violations_json(errors), {}, {});
    return kBadInput;
  }
  const std::vector<MountingWarning> warnings = mounting_warnings(params, sensor);
  for (const MountingWarning& w : warnings) {
    if (!o.json) fmt::print(stderr, "whisker: {}: warning: {}\n", o.file, w.text);
  }
  Params driven = params;
  bend_if_chosen(driven, o.planner);
  const std::vector<TestDrive> drives = test_drives(driven, sensor, o.planner);
  const bool fit = std::all_of(drives.begin(), drives.end(), reached);
  if (o.json) print_json(o, &params, Json::array(), warnings, drives);
  for (const TestDrive& drive : drives) {
    if (!o.json) fmt::print(out, "{}: {}\n", drive.world, report::verdict_words(drive.result));
    if (!reached(drive)) {
      fmt::print(stderr, "whisker: {}: the drive through {} failed: {}\n", o.file, drive.world,
                 report::verdict_words(drive.result));
    }
  }
  if (!fit) return kFault;
  if (!o.header.empty()) files::write(o.header, robot_header(params, o.file));
  if (!o.json) {
    fmt::print(out, "fit: {}\n", o.file);
    if (!o.header.empty()) fmt::print(out, "header: {}\n", o.header);
  }
  return 0;
}

constexpr const char* kStatus = R"(
Exit status of robot check: 0 fit, 2 a parameter or a relation is wrong: every one, a line each,
6 a test drive failed, 1 anything else. A warning (walls that may be invisible, ground that no cone
sees in time) is a line on standard error and changes no status.)";

}  // namespace

void add_robot_check(CLI::App& robot, int& status) {
  CLI::App* cmd =
      robot.add_subcommand("check", "Say whether a robot's parameters fit, and drive it a little");
  const auto o = std::make_shared<RobotOptions>();
  add_file(*cmd, "ROBOT", o->file, "Robot file (TOML)")->required();
  add_file(*cmd, "--header", o->header, "Write the parameters of a fit robot as a C++ header");
  add_planner(*cmd, o->planner);
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object and nothing else");
  cmd->footer(kStatus);
  cmd->callback([o, &status] { status = execute(*o); });
}

void add_robot(CLI::App& app, int& status) {
  CLI::App* robot =
      app.add_subcommand("robot", "Check a robot's parameters, lay out its sensors, or measure them");
  robot->require_subcommand(1);
  add_robot_check(*robot, status);
  add_robot_layout(*robot, status);
  add_robot_calibrate(*robot, status);
  add_robot_calibrate_drive(*robot, status);
}

}  // namespace whisker::cli
