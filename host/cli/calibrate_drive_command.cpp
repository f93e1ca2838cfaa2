#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/calibration/drive_procedure.hpp"
#include "host/calibration/hand_measured.hpp"
#include "host/cli/bus_options.hpp"
#include "host/cli/calibrate_bus.hpp"
#include "host/cli/calibrate_drive_bus.hpp"
#include "host/cli/calibrate_drive_output.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/report/file.hpp"
#include "host/report/spin_svg.hpp"
#include "host/scenario/load.hpp"

namespace whisker::cli {
namespace {

constexpr std::uint64_t kMostRobots = 100000;
constexpr double kTapeSigma = 0.002, kNoTapeSigma = 0.01;
constexpr double kShortestTape = 0.5, kShortestSide = 0.3;

struct DriveOptions {
  std::string robot;
  std::string truth;
  std::string scene = "room";
  bool noise = false;
  std::uint64_t seed = 1;
  std::uint64_t count = 0;
  int jobs = 0;
  std::optional<double> straight_m;
  std::optional<double> side_m;
  std::optional<int> squares;
  std::string tape;
  std::string square_ends;
  std::string svg;
  BusChoice bus;
  std::string mission;
  bool json = false;

  bool by_hand() const { return !tape.empty() || !square_ends.empty(); }
};

std::vector<std::string_view> scene_names() {
  std::vector<std::string_view> names;
  for (int i = 0; i < calibration::kScenes; ++i) names.emplace_back(name(static_cast<calibration::Scene>(i)));
  return names;
}

calibration::Scene scene_of(const std::string& word) {
  const auto names = scene_names();
  const auto at = std::find(names.begin(), names.end(), word);
  if (at == names.end())
    throw UsageError(fmt::format("--scene {}: discs, wall or room{}", word, did_you_mean(word, names)));
  return static_cast<calibration::Scene>(at - names.begin());
}

calibration::Tape tape_of(const std::string& text) {
  const auto wrong = [&](const char* why) { return UsageError(fmt::format("--tape {}: {}", text, why)); };
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw wrong("two lengths in m, as 5:5.034");
  const auto metres = [&](std::string_view part) {
    double value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc{} || end != part.data() + part.size()) throw wrong("two lengths in m, as 5:5.034");
    if (!(value >= kShortestTape && value <= 100)) throw wrong("both lengths are 0.5 to 100 m");
    return value;
  };
  const std::string_view all = text;
  const calibration::Tape tape{metres(all.substr(0, colon)), metres(all.substr(colon + 1))};
  if (std::abs(tape.driven_m / tape.measured_m - 1) > 0.2) throw wrong("they differ by more than 20 %");
  return tape;
}

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

/// That of the robot file, and with --noise what worlds with noise have.
Noise noise_of(const DriveOptions& o, Noise noise) {
  if (!o.noise) return noise;
  noise.range_sigma_m = 0.01;
  noise.range_dropout = 0.02;
  noise.range_false_clear = 0.01;
  noise.heading_drift_deg_per_sqrt_m = 0.3;
  return noise;
}

calibration::ProcedurePlan plan_of(const DriveOptions& o) {
  calibration::ProcedurePlan plan;
  plan.scene = scene_of(o.scene);
  plan.straight_m = o.straight_m.value_or(plan.straight_m);
  plan.side_m = o.side_m.value_or(plan.side_m);
  plan.squares = o.squares.value_or(plan.squares);
  return plan;
}

calibration::WheelErrors errors_of(const Params& believed, const Params& real) {
  const auto share = [&](calibration::Quantity q) {
    return static_cast<double>(value_in(real, q)) / value_in(believed, q);
  };
  using calibration::Quantity;
  return {share(Quantity::gyro_scale), share(Quantity::wheel_ratio), share(Quantity::counts_per_metre),
          share(Quantity::track)};
}

report::SpinPicture picture_of(const calibration::SpinSeen& spin, const Params& params) {
  constexpr double kDegrees = 360.0 / planning::RangeProfile::kTurn;
  constexpr const char* kNames[] = {"left", "front", "right"};
  report::SpinPicture picture;
  picture.title = "The spin of a calibration";
  picture.offset_deg = spin.offset_deg;
  picture.window_deg = planning::ProfileMatch::kWindow * kDegrees;
  picture.mismatch_mm = spin.mismatch_mm;
  picture.range_m = params.rangefinders.max_range.raw() * 1e-6;
  for (int i = 0; i < hal::kBeams; ++i) {
    report::SpinPicture::Beam beam{kNames[i], {}, {}};
    const auto take = [&](const planning::RangeProfile& from, std::vector<report::Sighting>& to) {
      for (int k = 0; k < from.count(i); ++k) {
        const auto& sample = from.at(i, k);
        to.push_back({(sample.at - planning::ProfileMatch::kWindow) * kDegrees, sample.mm * 1e-3});
      }
    };
    take(spin.first, beam.first);
    take(spin.last, beam.last);
    picture.beams.push_back(beam);
  }
  return picture;
}

struct Robot {
  Params params;
  Sensor sensor;
  Noise noise;
};

Robot read_robot_of(const DriveOptions& o) {
  Scenario scenario;
  apply_robot_file(scenario, o.robot);
  return {scenario.robot, scenario.sensor, noise_of(o, scenario.noise)};
}

DriveReport report_of(const DriveOptions& o, const Robot& robot, const calibration::Procedure& done,
                      const calibration::WheelErrors& errors, std::uint64_t seed) {
  DriveReport report;
  report.source = fmt::format("simulated robot, seed {}, spin in the scene {}", seed, o.scene);
  report.robot = o.robot;
  report.before = robot.params;
  report.steps = done.steps;
  report.values = done.values;
  report.refused = done.refused;
  report.truth = errors;
  return report;
}

/// Exit status.
int print(const DriveOptions& o, const DriveReport& report) {
  bool measured = true;
  if (o.json) {
    Provenance p;
    if (report.truth) p.seed = o.seed;
    p.robot_name = o.robot;
    p.robot_digest = robot_digest(report.before);
    fmt::print("{}\n", with_provenance(drive_json(report), p));
  } else {
    std::FILE* const out = words_beside({o.svg});
    fmt::print(out, "{}", drive_words(report));
    if (!o.svg.empty()) fmt::print(out, "\npicture: {}\n", o.svg);
  }
  for (const calibration::ProcedureStep& step : report.steps) {
    if (step.ended.good()) continue;
    measured = false;
    fmt::print(stderr, "whisker: {}: no result: {}\n", step.name, step.ended.trouble);
  }
  if (report.refused != ParamFault::none) {
    fmt::print(stderr, "whisker: the values do not fit the robot: {}: {}\n", name(report.refused),
               relation(report.refused).words);
  }
  return measured && report.refused == ParamFault::none ? 0 : kFault;
}

int simulate(const DriveOptions& o) {
  const Robot robot = read_robot_of(o);
  calibration::WheelErrors errors = calibration::draw({}, o.seed);
  if (!o.truth.empty()) {
    Params real = robot.params;
    apply_robot_file(real, o.truth);
    errors = errors_of(robot.params, real);
  }
  const calibration::Procedure done =
      calibration::play(robot.params, robot.sensor, robot.noise, errors, plan_of(o), o.seed);
  if (!o.svg.empty()) report::write_file(o.svg, report::spin_svg(picture_of(done.spin, robot.params)));
  return print(o, report_of(o, robot, done, errors, o.seed));
}

int by_hand(const DriveOptions& o) {
  const Robot robot = read_robot_of(o);
  DriveReport report;
  report.source = "measured by hand";
  report.robot = o.robot;
  report.before = robot.params;
  Params params = robot.params;
  const calibration::ProcedurePlan plan = plan_of(o);
  double scale = 1, scale_sigma = kNoTapeSigma;
  if (!o.tape.empty()) {
    const calibration::Tape tape = tape_of(o.tape);
    calibration::take_tape(tape, kTapeSigma, params, report.values);
    scale = tape.measured_m / tape.driven_m;
    scale_sigma = kTapeSigma / tape.measured_m;
    report.steps.push_back({"tape",
                            fmt::format("drove {} m by its wheels, {} m by the tape; +-{:.0f} mm assumed",
                                        tape.driven_m, tape.measured_m, kTapeSigma * 1e3),
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
  return print(o, report);
}

int many(const DriveOptions& o) {
  const Robot robot = read_robot_of(o);
  std::vector<DriveTrial> all(o.count);
  std::atomic<std::uint64_t> next{0};
  const auto work = [&] {
    for (std::uint64_t i = next++; i < o.count; i = next++) {
      const std::uint64_t seed = o.seed + i;
      const calibration::WheelErrors errors = calibration::draw({}, seed);
      const calibration::Procedure done =
          calibration::play(robot.params, robot.sensor, robot.noise, errors, plan_of(o), seed);
      all[i] = {report_of(o, robot, done, errors, seed), done.complete()};
    }
  };
  const unsigned cores = std::max(std::thread::hardware_concurrency(), 1U);
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < (o.jobs > 0 ? static_cast<unsigned>(o.jobs) : cores); ++i)
    threads.emplace_back(work);
  work();
  for (std::thread& t : threads) t.join();
  if (o.json) {
    Provenance p;
    p.seed = o.seed;
    p.robot_name = o.robot;
    p.robot_digest = robot_digest(robot.params);
    fmt::print("{}\n", with_provenance(drive_trials_json(all), p));
  } else {
    fmt::print("{} robots, seeds {} to {}, spin in the scene {}\n\n{}", o.count, o.seed, o.seed + o.count - 1,
               o.scene, drive_trials_words(all));
  }
  return 0;
}

/// One mission of the robot on the bus.
int on_bus(const DriveOptions& o) {
  const Robot robot = read_robot_of(o);
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
  return print(o, report);
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
  if (o.by_hand()) return by_hand(o);
  return o.count > 0 ? many(o) : simulate(o);
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
