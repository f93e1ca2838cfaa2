#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "firmware/calibration/values.hpp"
#include "host/cli/bus_run.hpp"
#include "host/cli/calibrate_bus.hpp"
#include "host/cli/calibrate_drive_output.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/harness/hil/line.hpp"
#include "host/harness/scenario/error.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/lab/calibration/hand_measured.hpp"

namespace whisker::cli {
namespace {

struct BusMission {
  std::string trouble;  ///< empty: it has a result
  calibration::Values values;
  std::string found;  ///< for people
};

std::vector<std::string_view> scene_names() {
  std::vector<std::string_view> names;
  for (int i = 0; i < calibration::kScenes; ++i) names.emplace_back(name(static_cast<calibration::Scene>(i)));
  return names;
}

/// That of the robot file, and with --noise what worlds with noise have.
Noise noise_of(const DriveOptions& o, Noise noise) {
  if (!o.noise) return noise;
  noise.range_sigma_m = 0.01;
  noise.range_dropout = 0.02;
  noise.range_false_clear = 0.01;
  noise.heading_drift_deg_per_sqrt_m = 0.3;
  return noise;
}

constexpr double kNoTapeSigma = 0.01;

/// The base learns of the end before the controller leaves.
constexpr std::chrono::milliseconds kLeaveAfter{500};

/// Takes the controller's place on the bus: waits for the base and its order to start, drives the mission
/// under the guard of the core, and stops. length_m: of a straight drive or a side. Prints what it waits for
/// on standard error. Throws Interrupted.
BusMission drive_mission_on_bus(const BusChoice& bus, const Params& params, const std::string& mission,
                                double length_m, hil::Line& line) {
  using Clock = std::chrono::steady_clock;
  CalibrationMission planners(mission, length_m);
  std::string early;
  std::optional<Clock::time_point> over;
  const bool interrupted = control_mission_on_bus(
      bus, planners, line,
      [&](const std::string& words) {
        if (planners.trouble() == planning::Trouble::not_finished && planners.made() && words != "drives")
          early = words;
      },
      [&] {
        const bool ended =
            planners.made() && (planners.trouble() != planning::Trouble::not_finished || !early.empty());
        if (ended && !over) over = Clock::now();
        return over && Clock::now() - *over > kLeaveAfter;
      });
  if (interrupted) throw Interrupted("");
  if (robot_digest(planners.params()) != robot_digest(params)) {
    fmt::print(stderr, "whisker: the base sent other parameters than those of the robot file\n");
  }
  BusMission result;
  const planning::Trouble trouble = planners.trouble();
  if (trouble != planning::Trouble::none) {
    result.trouble = trouble == planning::Trouble::not_finished ? "it ended early: " + early : name(trouble);
    return result;
  }
  result.values = planners.values();
  result.found = planners.found();
  return result;
}

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
  if (!o.bus.name.empty()) return on_bus(o);
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

calibration::Scene scene_of(const std::string& word) {
  const auto names = scene_names();
  const auto at = std::find(names.begin(), names.end(), word);
  if (at == names.end())
    throw UsageError(fmt::format("--scene {}: discs, wall or room{}", word, did_you_mean(word, names)));
  return static_cast<calibration::Scene>(at - names.begin());
}

calibration::ProcedurePlan plan_of(const DriveOptions& o) {
  calibration::ProcedurePlan plan;
  plan.scene = scene_of(o.scene);
  plan.straight_m = o.straight_m.value_or(plan.straight_m);
  plan.side_m = o.side_m.value_or(plan.side_m);
  plan.squares = o.squares.value_or(plan.squares);
  return plan;
}

DriveRobot read_robot_of(const DriveOptions& o) {
  Scenario scenario;
  apply_robot_file(scenario, o.robot);
  return {scenario.robot, scenario.sensor, noise_of(o, scenario.noise)};
}

int print_drive(const DriveOptions& o, const DriveReport& report) {
  if (o.json) {
    const auto seed = report.truth ? std::optional(o.seed) : std::nullopt;
    print_object(drive_json(report), {seed, {}, o.robot, robot_digest(report.before)});
  } else {
    std::FILE* const out = words_beside({o.svg});
    fmt::print(out, "{}", drive_words(report));
    if (!o.svg.empty()) fmt::print(out, "\npicture: {}\n", o.svg);
  }
  return print_failures(report);
}

calibration::Tape tape_of(const std::string& text) {
  const auto wrong = [&](const char* why) { return UsageError(fmt::format("--tape {}: {}", text, why)); };
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw wrong("two lengths in m, as 5:5.034");
  const auto metres = [&](std::string_view part) {
    double value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc{} || end != part.data() + part.size()) throw wrong("two lengths in m, as 5:5.034");
    if (!(value >= 0.5 && value <= 100)) throw wrong("both lengths are 0.5 to 100 m");
    return Length::from_raw(static_cast<std::int32_t>(std::lround(value * 1e6)));
  };
  const std::string_view all = text;
  const calibration::Tape tape{metres(all.substr(0, colon)), metres(all.substr(colon + 1))};
  if (!tape.plausible()) throw wrong("they differ by more than 20 %");
  return tape;
}

int compute_drive(const DriveOptions& o) {
  const DriveRobot robot = read_robot_of(o);
  DriveReport report;
  report.source = "measured by hand";
  report.robot = o.robot;
  report.before = robot.params;
  Params params = robot.params;
  const calibration::ProcedurePlan plan = plan_of(o);
  double scale = 1, scale_sigma = kNoTapeSigma;
  if (!o.tape.empty()) {
    const calibration::Tape tape = tape_of(o.tape);
    calibration::take_tape(report.values, params, tape);
    scale = 1.0 * tape.measured.raw() / tape.driven.raw();
    scale_sigma = 1.0 * calibration::Tape::kSigma.raw() / tape.measured.raw();
    report.steps.push_back({"tape",
                            fmt::format("drove {} m by its wheels, {} m by the tape; +-{:.0f} mm assumed",
                                        tape.driven.raw() * 1e-6, tape.measured.raw() * 1e-6,
                                        calibration::Tape::kSigma.raw() * 1e-3),
                            {}});
    report.refused = apply(report.values, params);
  }
  if (!o.square_ends.empty() && report.refused == ParamFault::none) {
    std::ifstream in(o.square_ends);
    if (!in) throw InputError(o.square_ends, 1, 1, "cannot open");
    std::vector<calibration::SquareEnd> ends = calibration::read_square_ends(in, o.square_ends);
    // The squares were driven with the lengths of the robot file.
    for (calibration::SquareEnd& end : ends) end.believed_x_m *= scale, end.believed_y_m *= scale;
    calibration::ProcedureStep step{"squares", "", {}};
    try {
      const calibration::Umbmark found =
          calibration::take_squares(ends, plan.side_m * scale, scale_sigma, params, report.values);
      step.found = fmt::format("{} of {} m; ratio and track leave {:.1f} mm of a coordinate", ends.size(),
                               plan.side_m, found.residual_m * 1e3);
      report.refused = apply(report.values, params);
    } catch (const std::runtime_error& e) {
      step.ended.trouble = e.what();
    }
    report.steps.push_back(step);
  }
  return print_drive(o, report);
}

void add_robot_calibrate_drive(CLI::App& robot, int& status) {
  CLI::App* cmd = robot.add_subcommand("calibrate-drive", "Measure what the wheels and the gyro are worth");
  const auto o = std::make_shared<DriveOptions>();
  add_file(*cmd, "ROBOT", o->robot, "Robot file (TOML): what the robot believes")->required();
  add_name(*cmd, "--tape", o->tape, "Of a straight drive: m by the robot : m by the tape, as 5:5.034")
      ->type_name("M:M");
  add_file(*cmd, "--square-ends", o->square_ends, "Ends of squares as a person measured them (CSV)");
  amount(cmd->add_option("--side", o->side_m, "Side of the squares, m; 1 by default"), "M", 10);
  add_file(*cmd, "--true", o->truth, "The simulated robot's true values (TOML), instead of drawn ones");
  add_name(*cmd, "--scene", o->scene, "Around the simulated spin: discs, wall or room (default)")
      ->type_name("NAME");
  add_switch(*cmd, "--noise", o->noise, "With the noise of worlds with noise, besides the robot file's");
  within(cmd->add_option("--straight", o->straight_m,
                         "Length of the straight drive, m; 3 by default, 5 along a tape"),
         "M", 0.5, 20.0);
  within(cmd->add_option("--squares", o->squares, "Simulated squares to each side; 5 by default"), "N", 2,
         50);
  whole_number(cmd->add_option("--seed", o->seed, "Of true values, scene and noise; 1 by default"), "S");
  how_many(
      cmd->add_option("--count", o->count, "Calibrate so many random robots instead, and print the errors"),
      "N", kMostRobots);
  within(cmd->add_option("--jobs", o->jobs, "Threads of --count; by default one a core"), "N", 1, 256);
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
