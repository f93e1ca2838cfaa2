#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/report/file.hpp"
#include "host/report/result.hpp"
#include "host/report/run_svg.hpp"
#include "host/report/trace.hpp"
#include "host/run/runner.hpp"
#include "host/scenario/load.hpp"

namespace whisker::cli {
namespace {

struct Options {
  std::string scenario;
  PlannerKind planner = PlannerKind::skirt;
  std::string robot;
  std::optional<std::uint64_t> seed;
  std::string trace;
  std::string svg;
  bool json = false;
};

int execute(const Options& o) {
  check_outputs({o.trace, o.svg}, {o.scenario, o.robot});
  Scenario scenario = load_scenario(o.scenario);
  if (!o.robot.empty()) apply_robot_file(scenario, o.robot);

  std::vector<TickRecord> records;
  RunOptions options;
  options.seed = o.seed;
  options.planner = o.planner;
  if (!o.trace.empty() || !o.svg.empty()) options.records = &records;
  RunResult result;
  {
    ProgressLine line;
    auto last = std::chrono::steady_clock::now();
    options.progress = [&](double time_s, double distance_m) {
      const auto now = std::chrono::steady_clock::now();
      if (now - last < std::chrono::milliseconds(200)) return;
      last = now;
      line.show(fmt::format("{:.0f} s of at most {:.0f} s simulated, {:.2f} m from the goal", time_s,
                            scenario.time_limit_s, distance_m));
    };
    result = run(scenario, options);
  }
  if (!o.trace.empty()) report::write_trace(o.trace, scenario, records);
  if (!o.svg.empty()) report::write_file(o.svg, report::run_svg(scenario, records, result));

  if (o.json) {
    fmt::print("{}\n", report::result_json(result));
  } else {
    fmt::print("{}\n{:.2f} m from the goal after {} ticks, command hash {:016x}\n",
               report::verdict_words(result), result.final_distance_m, result.ticks, result.hash);
    if (!o.trace.empty()) fmt::print("trace:   {}\n", o.trace);
    if (!o.svg.empty()) fmt::print("picture: {}\n", o.svg);
  }
  return exit_status(result.verdict);
}

}  // namespace

void add_run(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("run", "Drive the simulated robot through a scenario file");
  const auto o = std::make_shared<Options>();
  add_file(*cmd, "SCENARIO", o->scenario, "Scenario file (TOML)")->required();
  add_planner(*cmd, o->planner);
  add_file(*cmd, "--robot", o->robot, "Parameters of your robot (TOML), over those of the scenario");
  cmd->add_option("--seed", o->seed, "Seed of the noise, instead of the scenario's")
      ->transform(whole_number())
      ->type_name("N");
  add_file(*cmd, "--trace", o->trace, "Write one CSV row per control tick");
  add_file(*cmd, "--svg", o->svg, "Draw the run");
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object and nothing else");
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
