#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/cli/bench_bus.hpp"
#include "host/cli/calibrate_bus.hpp"
#include "host/cli/calibrate_drive_output.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/provenance.hpp"
#include "host/lab/calibration/drive_procedure.hpp"

namespace whisker::cli {
namespace {

struct BenchMission {
  BenchChoice bus;
  std::string mission;
  std::optional<double> length_m;
  double for_s = 600;
  bool json = false;
};

double length_of(const BenchMission& o) {
  const calibration::ProcedurePlan usual;
  const double by_default = o.mission == "straight" ? usual.straight_m
                            : o.mission == "tape"   ? usual.tape_m
                                                    : usual.side_m;
  return o.length_m.value_or(by_default);
}

void check_use(const BenchMission& o) {
  const auto missions = mission_names();
  if (std::find(missions.begin(), missions.end(), o.mission) == missions.end()) {
    throw UsageError(fmt::format("bench calibrate {}: spin, straight, tape, square-left or square-right{}",
                                 o.mission, did_you_mean(o.mission, missions)));
  }
  if (o.length_m && o.mission == "spin") throw UsageError("bench calibrate spin: --length has no meaning");
}

int execute(const BenchMission& o) {
  check_use(o);
  BenchBus bus(o.bus);
  bus.meet();
  check_place(bus, o.bus);
  CalibrationMission mission(o.mission, length_of(o));
  bench::GoalSeat seat(bus.port(), o.bus.bus.identity(), mission, {{1_m, 0_m}, 100_mm}, {});
  const auto over = [&] {
    const Status& s = seat.status();
    return s.health.fault != Fault::none || s.decision.outcome != planning::Outcome::running;
  };
  sit(bus, o.bus, seat, o.for_s, over, [&] { return bus.interrupt().noted(); });
  const Fault fault = seat.status().health.fault;
  const planning::Trouble trouble = mission.trouble();
  DriveReport report;
  report.source = fmt::format("robot {} on {}", bus.robot(), bus.name());
  report.robot = "the robot file";
  report.before = mission.params();
  calibration::ProcedureStep step{o.mission, "", {}};
  if (fault != Fault::none) {
    step.ended.trouble = name(fault);
  } else if (trouble != planning::Trouble::none) {
    step.ended.trouble = name(trouble);
  } else {
    step.found = mission.found();
    report.values = mission.values();
    Params params = report.before;
    report.refused = apply(report.values, params);
  }
  report.steps.push_back(step);
  if (o.json) {
    print_object(drive_json(report), {{}, {}, {}, robot_digest(report.before)});
  } else {
    fmt::print("{}", drive_words(report));
  }
  return print_failures(report);
}

}  // namespace

void add_bench_calibrate(CLI::App& bench, int& status) {
  const auto o = std::make_shared<BenchMission>();
  CLI::App* cmd = bench.add_subcommand(
      "calibrate", "Measure wheels and gyro of a real base, with the core on this computer");
  add_name(*cmd, "MISSION", o->mission, "spin, straight, tape, square-left or square-right")->required();
  add_bench_bus(*cmd, o->bus);
  within(cmd->add_option("--length", o->length_m,
                         "Of a drive or the side of a square, m; by default\nstraight 3, tape 5, square 1"),
         "M", 0.5, 20.0);
  amount(cmd->add_option("--for", o->for_s, "End after this time, s; 600 by default"), "S",
         BenchBus::kMost_s);
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object and nothing else");
  cmd->callback([o, &status] { status = bench_status([&] { return execute(*o); }); });
}

}  // namespace whisker::cli
