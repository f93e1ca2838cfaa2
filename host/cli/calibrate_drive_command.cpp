#include <algorithm>
#include <memory>
#include <string>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/cli/calibrate_bus.hpp"
#include "host/cli/calibrate_drive_bus.hpp"
#include "host/cli/calibrate_drive_options.hpp"
#include "host/cli/calibrate_missions.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"

namespace whisker::cli {
namespace {

constexpr std::uint64_t kMostRobots = 100000;
constexpr double kShortestSide = 0.3;

void check_use(const DriveOptions& o) {
  const bool simulated =
      !o.truth.empty() || o.noise || o.count > 0 || !o.svg.empty() || o.straight_m || o.squares;
  if (o.by_hand() && simulated) {
    throw UsageError(
        "--tape and --square-ends are of a real robot: not with --true, --noise, --count, --straight, "
        "--squares "
        "or --svg");
  }
  if (o.count > 0 && (!o.truth.empty() || !o.svg.empty())) {
    throw UsageError("--count draws the robots: not with --true or --svg");
  }
  if (o.side_m && *o.side_m < kShortestSide) {
    throw UsageError(fmt::format("--side {}: {} m at least", *o.side_m, kShortestSide));
  }
  const bool bus = !o.bus.name.empty();
  if (bus && (o.by_hand() || !o.truth.empty() || o.noise || o.count > 0 || !o.svg.empty() || o.squares)) {
    throw UsageError(
        "--can drives a real robot: only with --mission, --straight, --side and options of the bus");
  }
  if (bus != !o.mission.empty()) throw UsageError("--can and --mission: both or none");
  if (!bus && (!o.bus.record.empty() || o.bus.real_time))
    throw UsageError("--record and --realtime: only with --can");
  const auto missions = mission_names();
  if (bus && std::find(missions.begin(), missions.end(), o.mission) == missions.end()) {
    throw UsageError(fmt::format("--mission {}: spin, straight, tape, square-left or square-right{}",
                                 o.mission, did_you_mean(o.mission, missions)));
  }
  if (!o.tape.empty()) tape_of(o.tape);
  scene_of(o.scene);
}

/// One mission of the robot on the bus.
int on_bus(const DriveOptions& o) {
  const DriveRobot robot = read_robot_of(o);
  const calibration::ProcedurePlan plan = plan_of(o);
  const bool square = o.mission.rfind("square", 0) == 0;
  const double length = square                ? plan.side_m
                        : o.mission == "tape" ? o.straight_m.value_or(plan.tape_m)
                                              : plan.straight_m;
  DriveReport report;
  report.source = fmt::format("robot {} on {}", o.bus.robot, o.bus.name);
  report.robot = o.robot;
  report.before = robot.params;
  const auto line = hil::open_line(o.bus.name);
  const BusMission done = drive_mission_on_bus(o.bus, robot.params, o.mission, length, *line);
  report.values = done.values;
  Params params = robot.params;
  report.refused = apply(report.values, params);
  report.steps.push_back({o.mission, done.found, {done.trouble, 0}});
  return print_drive(o, report);
}

int execute(const DriveOptions& o) {
  check_outputs({o.svg, o.bus.record}, {o.robot, o.truth, o.square_ends}, o.json);
  check_use(o);
  if (!o.bus.name.empty()) {
    try {
      return on_bus(o);
    } catch (const SpinInterrupted&) {
      return kInterrupted;
    }
  }
  if (o.by_hand()) return compute_drive(o);
  return o.count > 0 ? simulate_drives(o) : simulate_drive(o);
}

constexpr const char* kFooter = R"(
Plays the calibration of wheels and gyro with a simulated robot whose true values are drawn, 1 %
each: a drive along a tape, a spin, and a straight drive (with a gyro) or squares (without).
With --can and --mission, the core drives one of them with the robot on the bus, under its guard.
With --tape or --square-ends, computes the values of a real robot that a person has measured.
The CSV of --square-ends has the columns side (left or right), x_m and y_m (x ahead of the start,
y to its left), and if known believed_x_m and believed_y_m, by the robot's odometry.
Exit status of robot calibrate-drive: 0 all was measured, 6 something was not (standard error says
why), 130 interrupted, 2 bad input or usage, 1 anything else.)";

}  // namespace

void add_robot_calibrate_drive(CLI::App& robot, int& status) {
  CLI::App* cmd = robot.add_subcommand("calibrate-drive", "Measure what the wheels and the gyro are worth");
  const auto o = std::make_shared<DriveOptions>();
  add_file(*cmd, "ROBOT", o->robot, "Robot file (TOML): what the robot believes")->required();
  add_name(*cmd, "--tape", o->tape, "Of a straight drive: m by the robot : m by the tape, as 5:5.034")
      ->type_name("M:M");
  add_file(*cmd, "--square-ends", o->square_ends, "Ends of squares as a person measured them (CSV)");
  cmd->add_option("--side", o->side_m, "Side of the squares, m; 1 by default")
      ->transform(amount(10))
      ->type_name("M");
  add_file(*cmd, "--true", o->truth, "The simulated robot's true values (TOML), instead of drawn ones");
  add_name(*cmd, "--scene", o->scene, "Around the simulated spin: discs, wall or room (default)")
      ->type_name("NAME");
  add_switch(*cmd, "--noise", o->noise, "With the noise of worlds with noise, besides the robot file's");
  cmd->add_option("--straight", o->straight_m,
                  "Length of the straight drive, m; 3 by default, 5 along a tape")
      ->check(CLI::Range(0.5, 20.0))
      ->type_name("M");
  cmd->add_option("--squares", o->squares, "Simulated squares to each side; 5 by default")
      ->check(CLI::Range(2, 50))
      ->type_name("N");
  cmd->add_option("--seed", o->seed, "Of true values, scene and noise; 1 by default")
      ->transform(whole_number())
      ->type_name("S");
  cmd->add_option("--count", o->count, "Calibrate so many random robots instead, and print the errors")
      ->transform(whole_number(kMostRobots))
      ->type_name("N");
  cmd->add_option("--jobs", o->jobs, "Threads of --count; by default one a core")
      ->check(CLI::Range(1, 256))
      ->type_name("N");
  add_bus(*cmd, o->bus);
  add_switch(*cmd, "--realtime", o->bus.real_time, "With --can: run before other processes");
  add_name(
      *cmd, "--mission", o->mission,
      "With --can: drive this with the robot on the bus: spin,\nstraight, tape, square-left or square-right")
      ->type_name("NAME");
  add_file(*cmd, "--svg", o->svg, "Write a picture of the simulated spin and its match");
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object and nothing else");
  cmd->footer(kFooter);
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
