#include <algorithm>
#include <cmath>
#include <memory>
#include <regex>
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
#include "host/harness/scenario/param_list.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/scenario/robot_header.hpp"
#include "host/harness/scenario/sensor.hpp"
#include "host/harness/scenario/sensor_text.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/lab/report/result.hpp"
#include "host/lab/report/units.hpp"

namespace whisker::cli {
namespace {

struct TestDrive {
  std::string world;  ///< "the empty world", "the corridor", "the field of discs"
  RunResult result;
  double straight_s = 0;  ///< of the straight way at full speed
};

/// A fit robot takes at most this many times the time of the straight way.
constexpr double kMostDetour = 20;

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
      std::max(2 * metres(derived::drive_tolerance(params)), metres(planning::smallest_tolerance(params))));
  const sim::Vec2 way = s.goal.at - s.start.at;
  s.time_limit_s = 600 + 40 * std::sqrt(sim::dot(way, way)) / (params.wheels.max_speed.raw() * 1e-6);
  s.noise = {};
  s.sensor = sensor;
  s.robot = params;
  return s;
}

/// With these sensors and no other noise, in worlds that scale with the body. The parameters must pass
/// check().
std::vector<TestDrive> test_drives(Params params, const Sensor& sensor, PlannerKind planner) {
  bend_if_chosen(params, planner);
  const double wide = 2.8 * (1 + metres(derived::planning_margin(params)) / metres(params.body.radius));
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
    const Scenario own = fitted(scenario, params, sensor);
    const sim::Vec2 way = own.goal.at - own.start.at;
    drives.push_back(
        {name, run(own, options), std::sqrt(sim::dot(way, way)) / (params.wheels.max_speed.raw() * 1e-6)});
  }
  return drives;
}

using Json = nlohmann::ordered_json;

struct RobotOptions {
  std::string file;
  std::string header;
  std::string suggest;
  std::vector<double> body;  // length, width, axle; empty: not told
  PlannerKind planner = kDefaultPlanner;
  bool json = false;
};

bool slow(const TestDrive& drive) { return drive.result.time_s > kMostDetour * drive.straight_s; }

bool good(const TestDrive& drive) { return drive.result.verdict == Verdict::reached && !slow(drive); }

Json violations_json(const InputErrors& errors) {
  Json all = Json::array();
  for (const InputError& e : errors.all()) {
    all.push_back({{"line", e.line()}, {"column", e.column()}, {"text", e.what()}});
  }
  return all;
}

/// Null: there is none.
Json suggestion_json(const InputErrors& errors) {
  Json all;
  for (const auto& [key, value] : errors.changes()) all[key] = Json::parse(value, nullptr, false);
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
                const std::vector<MountingWarning>& warnings, const std::vector<TestDrive>& drives,
                const Json& suggestion = nullptr) {
  const bool fit = params != nullptr && std::all_of(drives.begin(), drives.end(), good);
  Json json = {{"fit", fit},
               {"violations", violations},
               {"warnings", warnings_json(warnings)},
               {"drives", drives_json(drives)}};
  if (!suggestion.is_null()) json["suggestion"] = suggestion;
  if (params != nullptr) json["unset"] = unset_keys(o.file);
  Provenance provenance{{}, name(o.planner), o.file, {}, rules_name(o.planner)};
  if (params != nullptr) provenance.robot_digest = robot_digest(*params);
  print_object(json.dump(-1, ' ', false, Json::error_handler_t::replace), provenance);
}

/// The file's text with these lines instead of its own, or on top.
std::string with_lines(const std::string& text,
                       const std::vector<std::pair<std::string, std::string>>& lines) {
  std::string changed = text, added;
  for (const auto& [key, value] : lines) {
    const std::regex own("(^|\n)([ \t]*\"?" + key + "\"?[ \t]*=[ \t]*)[^\n#]*?([ \t\r]*)(?=#|\n|$)");
    std::smatch found;
    if (std::regex_search(changed, found, own)) {
      changed = found.prefix().str() + found[1].str() + found[2].str() + value + found[3].str() +
                found.suffix().str();
    } else {
      added += fmt::format("{} = {}\n", key, value);
    }
  }
  return added + changed;
}

/// "body_radius_m = 0.09": what the robot takes from the reference robot although no other has the same.
std::string unset_words(const std::string& file, const Params& params) {
  const std::vector<std::string_view> unset = unset_keys(file);
  std::string words;
  for (const ParamEntry& e : param_list(params)) {
    if (std::find(unset.begin(), unset.end(), std::string_view(e.key)) == unset.end()) continue;
    words += fmt::format("{}{} = {}", words.empty() ? "" : ", ", e.key, e.text());
  }
  return words;
}

/// Writes the file that fits, if there is one.
void suggest(const RobotOptions& o, const InputErrors& errors) {
  if (errors.changes().empty()) {
    fmt::print(stderr, "whisker: {}: no change of tolerances, steps and margins fits: {} is not written\n",
               o.file, o.suggest);
    return;
  }
  files::write(o.suggest, with_lines(read_file(o.file), errors.changes()));
  Params params;
  Sensor sensor;
  apply_robot_file(params, sensor, o.suggest);
  for (const TestDrive& drive : test_drives(params, sensor, o.planner)) {
    if (!good(drive))
      fmt::print(stderr, "whisker: {}: the drive through {} fails: {}\n", o.suggest, drive.world,
                 report::verdict_words(drive.result));
  }
  if (!o.json) fmt::print(words_beside({o.suggest}), "suggestion: {}\n", o.suggest);
}

int execute(const RobotOptions& o) {
  check_outputs({o.header, o.suggest}, {o.file}, o.json);
  std::FILE* const out = words_beside({o.header, o.suggest});
  Params params;
  Sensor sensor;
  try {
    const bool told = !o.body.empty();
    const Rectangle body = told ? Rectangle{o.body[0], o.body[1], o.body[2]} : Rectangle{};
    if (told && body.axle > body.length) throw UsageError("--rectangle: the axle must lie within the length");
    apply_robot_file(params, sensor, o.file, told ? &body : nullptr);
    if (told && !o.json) {
      fmt::print(out, "body: within {:.4f} m around the middle of the axle; body_radius_m is {}\n",
                 body.radius_around_axle(), metres(params.body.radius));
    }
    std::vector<InputError> against;
    for (const std::string& text : contradictions(params, sensor)) against.emplace_back(o.file, 1, 1, text);
    if (!against.empty()) throw InputErrors(std::move(against));
  } catch (const InputErrors& errors) {
    if (!o.suggest.empty()) suggest(o, errors);
    if (!o.json) throw;
    print_json(o, nullptr, violations_json(errors), {}, {}, suggestion_json(errors));
    return kBadInput;
  }
  const std::vector<MountingWarning> warnings = mounting_warnings(params, sensor);
  for (const MountingWarning& w : warnings) {
    if (!o.json) fmt::print(stderr, "whisker: {}: warning: {}\n", o.file, w.text);
  }
  const std::vector<TestDrive> drives = test_drives(params, sensor, o.planner);
  const bool fit = std::all_of(drives.begin(), drives.end(), good);
  if (o.json) print_json(o, &params, Json::array(), warnings, drives);
  for (const TestDrive& drive : drives) {
    if (!o.json) fmt::print(out, "{}: {}\n", drive.world, report::verdict_words(drive.result));
    if (good(drive)) continue;
    fmt::print(stderr, "whisker: {}: the drive through {} failed: {}{}\n", o.file, drive.world,
               report::verdict_words(drive.result),
               drive.result.verdict == Verdict::reached
                   ? fmt::format(", more than {} times the {:.1f} s of the straight way at full speed",
                                 kMostDetour, drive.straight_s)
                   : "");
  }
  if (!fit) return kFault;
  if (!o.header.empty()) files::write(o.header, robot_header(params, o.file));
  if (!o.json) {
    const std::string unset = unset_words(o.file, params);
    if (!unset.empty()) fmt::print(out, "not set, so the reference robot's: {}\n", unset);
    const bool empty = robot_toml(params).empty() && sensor_toml(sensor).empty();
    fmt::print(out, "fit: {}{}\n", o.file, empty ? ", which sets nothing: this is the reference robot" : "");
    if (!o.suggest.empty()) fmt::print(out, "nothing to suggest: {} is not written\n", o.suggest);
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
  add_file(*cmd, "--suggest", o->suggest, "Write ROBOT with the changes that make all relations hold");
  amount(
      cmd->add_option("--rectangle", o->body,
                      "Also check that body_radius_m holds a rectangular body: length, width, and distance "
                      "of the axle from the front, m")
          ->expected(3),
      "LENGTH WIDTH AXLE", 4);
  add_planner(*cmd, o->planner);
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object and nothing else");
  cmd->footer(kStatus);
  cmd->callback([o, &status] { status = execute(*o); });
}

void add_robot(CLI::App& app, int& status) {
  CLI::App* robot = app.add_subcommand(
      "robot", "Check a robot's parameters, list robots, lay out sensors, or measure them");
  robot->require_subcommand(1);
  add_robot_check(*robot, status);
  add_robot_list(*robot, status);
  add_robot_layout(*robot, status);
  add_robot_calibrate(*robot, status);
  add_robot_calibrate_drive(*robot, status);
}

}  // namespace whisker::cli
