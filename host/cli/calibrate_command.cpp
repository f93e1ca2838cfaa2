#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/cli/bus_run.hpp"
#include "host/cli/calibrate_bus.hpp"
#include "host/cli/calibrate_output.hpp"
#include "host/cli/campaign_options.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/bearing.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/lab/calibration/log.hpp"
#include "host/lab/report/trace.hpp"

namespace whisker::cli {
namespace {

constexpr double kFarthestWall = 20;                       // m
constexpr double kShortestAlong = 0.1, kLongestAlong = 2;  // m
constexpr std::uint64_t kMostTrials = 100000;

struct CalibrateOptions {
  std::string robot;
  std::string log;
  BusChoice bus;
  std::optional<double> wall_deg;
  std::string truth;
  std::optional<double> distance;
  double along_m = 0;
  double turned_deg = 0;
  Noise noise;
  std::optional<double> phantom;
  std::uint64_t seed = 1;
  std::uint64_t count = 0;
  int jobs = 0;
  std::string trace;
  bool json = false;
};

struct Spun {
  calibration::Sweep sweep;
  double wall_deg = 0;
};

Spun simulate(const CalibrateOptions& o, const Params& params, const Sensor& sensor,
              CalibrationReport& report) {
  Params real = params;
  Sensor what = sensor;
  if (!o.truth.empty()) apply_robot_file(real = {}, what = {}, o.truth);
  if (o.phantom) what.phantom = *o.phantom;
  const double wall_m = o.distance.value_or(calibration::usual_distance_m(real, what));
  if (wall_m <= real.body.radius.raw() * 1e-6 + 0.01) {
    throw UsageError(fmt::format("--distance {}: the body needs more than {:.2f} m", wall_m,
                                 real.body.radius.raw() * 1e-6 + 0.01));
  }
  Scenario scenario = calibration::wall_scenario(real, what, o.noise, wall_m);
  scenario.start.heading = o.turned_deg * kRadPerDeg;
  const sim::RobotSpec spec = robot_spec(scenario);
  RunLog log({scenario, std::nullopt, o.seed});
  const calibration::Sweep sweep = calibration::simulated_spin(scenario, params, spec, o.seed, o.along_m,
                                                               o.trace.empty() ? nullptr : &log);
  if (!o.trace.empty()) report::write_trace(o.trace, log);
  report.source = fmt::format("simulated spin, wall {:.2f} m away, seed {}: {} readings of a beam", wall_m,
                              o.seed, sweep[0].size());
  report.truth.emplace();
  for (int i = 0; i < hal::kBeams; ++i) {
    (*report.truth)[static_cast<std::size_t>(i)] = calibration::truth(spec, i, wall_m);
  }
  return {sweep, 0};
}

Spun spin(const CalibrateOptions& o, const Params& params, const Sensor& sensor, CalibrationReport& report) {
  if (!o.log.empty()) {
    const calibration::Log log = calibration::read_log(o.log, params, o.bus.robot);
    report.source = fmt::format("{}: {} readings of a beam", o.log, log.sweep[0].size());
    return {log.sweep, log.start_deg};
  }
  if (!o.bus.name.empty()) {
    BusChoice bus = o.bus;
    bus.robot = std::max(bus.robot, 1);
    const auto line = hil::open_line(bus.name);
    Spun spun{spin_on_bus(bus, params, o.along_m, *line), 0};
    report.source = fmt::format("spin of robot {} on {}: {} readings of a beam", bus.robot, bus.name,
                                spun.sweep[0].size());
    return spun;
  }
  return simulate(o, params, sensor, report);
}

void check_use(const CalibrateOptions& o) {
  const bool real = !o.log.empty() || !o.bus.name.empty();
  if (!o.log.empty() && !o.bus.name.empty()) throw UsageError("--log and --can: choose one");
  const bool simulated = o.distance || o.turned_deg != 0 || o.phantom || !o.truth.empty() ||
                         !o.trace.empty() || o.noise.range_sigma_m > 0 || o.noise.range_dropout > 0 ||
                         o.noise.wheel_scale_sigma > 0;
  if (real && (simulated || o.count > 0)) {
    throw UsageError(
        "--true, --distance, --turned, --sigma, --dropout, --phantom, --wheel-scale-sigma, --count and "
        "--trace are of "
        "a "
        "simulated spin: not with --log or --can");
  }
  if (!o.log.empty() && o.along_m > 0) throw UsageError("--along drives a robot: not with --log");
  if (o.along_m > 0 && o.along_m < kShortestAlong) {
    throw UsageError(fmt::format("--along {}: 0, or {} m at least", o.along_m, kShortestAlong));
  }
  if (o.log.empty() && o.wall_deg) throw UsageError("--wall-heading: only with --log");
  if (o.bus.name.empty() && !o.bus.record.empty()) throw UsageError("--record: only with --can");
  if (o.bus.name.empty() && o.bus.real_time) throw UsageError("--realtime: only with --can");
  if (o.count > 0 && (o.distance || o.turned_deg != 0 || !o.truth.empty() || !o.trace.empty())) {
    throw UsageError("--count makes random robots: not with --true, --distance, --turned or --trace");
  }
}

int many(const CalibrateOptions& o) {
  std::vector<calibration::TrialResult> all(o.count);
  all.resize(in_parallel(o.count, o.jobs, [&](std::uint64_t i) {
    all[i] =
        calibration::run(calibration::random_trial(o.noise, o.phantom.value_or(0), o.along_m, o.seed + i));
  }));
  const Interrupted interrupted(fmt::format(" after {} of {} robots", all.size(), o.count));
  if (all.empty()) throw interrupted;
  if (o.json) {
    print_object(trials_json(all), {o.seed});
  } else {
    fmt::print(
        "{} random robots, seeds {} to {}: noise {:.0f} mm, dropouts {:.0f} %, phantoms {:.0f} %, wheel "
        "scale {:.2g} %\n\n{}",
        all.size(), o.seed, o.seed + all.size() - 1, o.noise.range_sigma_m * 1e3, o.noise.range_dropout * 100,
        o.phantom.value_or(0) * 100, o.noise.wheel_scale_sigma * 100, trials_words(all));
  }
  if (all.size() < o.count) throw interrupted;
  return 0;
}

int measure(const CalibrateOptions& o) {
  check_outputs({o.trace, o.bus.record}, {o.robot, o.log, o.truth}, o.json);
  check_use(o);
  if (o.count > 0) return many(o);
  Params params;
  Sensor sensor;
  apply_robot_file(params, sensor, o.robot);
  CalibrationReport report;
  report.robot = o.robot;
  const Spun spun = spin(o, params, sensor, report);
  report.measured = calibration::calibrate(spun.sweep, params, o.wall_deg.value_or(spun.wall_deg));
  report.advice = calibration::advise(report.measured, params);
  if (o.json) {
    print_object(calibration_json(report), {o.seed, {}, o.robot, robot_digest(params)});
  } else {
    std::FILE* const out = words_beside({o.trace, o.bus.record});
    fmt::print(out, "{}", calibration_words(report));
    if (!o.trace.empty()) fmt::print(out, "trace: {}\n", o.trace);
  }
  for (std::size_t i = 0; i < report.measured.fits.size(); ++i) {
    const std::string words =
        calibration::trouble_words(report.measured.believed[i], report.measured.fits[i]);
    if (!words.empty()) {
      fmt::print(stderr, "whisker: the {} beam was not measured: {}\n", calibration::kBeamNames[i], words);
    }
  }
  return report.measured.complete() ? 0 : kFault;
}

int execute(const CalibrateOptions& o) {
  try {
    return measure(o);
  } catch (const SpinError& e) {
    fmt::print(stderr, "whisker: the spin ended early: {}\n", e.what());
    return kFault;
  }
}

constexpr const char* kCalibrateFooter = R"(
The robot stands 0.3 m in front of a long flat wall, square to it, and turns on the spot.
Without --log and --can the robot is simulated, with the [sensor] of its file.
Exit status of robot calibrate: 0 all beams were measured, 6 one was not (standard error says why),
130 interrupted, 2 bad input or usage, 1 anything else.)";

}  // namespace

void add_robot_calibrate(CLI::App& robot, int& status) {
  CLI::App* cmd = robot.add_subcommand("calibrate", "Measure where the beams point and which walls they see");
  const auto o = std::make_shared<CalibrateOptions>();
  o->bus.robot = 0;  // with --log: the first one
  add_file(*cmd, "ROBOT", o->robot, "Robot file (TOML): what the robot believes")->required();
  add_file(*cmd, "--log", o->log, "Analyse this log of a spin: a trace (CSV) or a candump log");
  add_bus(*cmd, o->bus);
  add_switch(*cmd, "--realtime", o->bus.real_time, "With --can: run before other processes");
  within(
      cmd->add_option("--wall-heading", o->wall_deg,
                      "With --log: the heading that faces the wall, in degrees; by default the log's first"),
      "DEG", -360.0, 360.0);
  add_file(*cmd, "--true", o->truth, "The simulated robot as it really is (TOML); by default as ROBOT");
  amount(cmd->add_option("--distance", o->distance, "From the robot's centre to the simulated wall, m"), "M",
         kFarthestWall);
  amount(
      cmd->add_option("--along", o->along_m,
                      "Then drive so many metres to the right, along the wall, and turn once more:\nmeasures "
                      "whether the body "
                      "stood square to the wall"),
      "M", kLongestAlong);
  within(cmd->add_option("--turned", o->turned_deg, "The simulated body stands so many degrees off square"),
         "DEG", -30.0, 30.0);
  amount(cmd->add_option("--sigma", o->noise.range_sigma_m, "Standard deviation of a simulated distance, m"),
         "M", 1);
  amount(cmd->add_option("--dropout", o->noise.range_dropout, "Probability that a simulated reading is lost"),
         "P", 1);
  amount(cmd->add_option("--false-clear", o->noise.range_false_clear,
                         "Probability that a simulated reading is wrongly clear"),
         "P", 1);
  amount(cmd->add_option("--phantom", o->phantom,
                         "Probability that a clear reading becomes an echo at 0.1 to 0.5 m"),
         "P", 1);
  amount(cmd->add_option("--wheel-scale-sigma", o->noise.wheel_scale_sigma,
                         "Scale error of the simulated wheels"),
         "S", 1);
  whole_number(cmd->add_option("--seed", o->seed, "Of the simulated noise; 1 by default"), "S");
  how_many(
      cmd->add_option("--count", o->count, "Measure so many random robots instead, and print the errors"),
      "N", kMostTrials);
  within(cmd->add_option("--jobs", o->jobs, "Threads of --count; by default one a core"), "N", 1, 256);
  add_file(*cmd, "--trace", o->trace, "Write the simulated spin as CSV, one row per control tick");
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object and nothing else");
  cmd->footer(kCalibrateFooter);
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
