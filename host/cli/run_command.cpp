#include <memory>
#include <optional>
#include <string>

#include <fmt/core.h>

#include "host/chip/chip_pilot.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/one_run.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
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
  std::string html;
  bool json = false;
  std::string chip;
};

int execute(const Options& o) {
  if (!o.chip.empty() && is_baseline(o.planner)) {
    throw UsageError(fmt::format("--chip: planner {} runs on this computer only", name(o.planner)));
  }
  check_outputs({o.trace, o.svg, o.html}, {o.scenario, o.robot});
  Scenario scenario = load_scenario(o.scenario);
  if (!o.robot.empty()) apply_robot_file(scenario, o.robot);

  RunOptions options;
  options.seed = o.seed;
  options.planner = o.planner;
  if (!o.chip.empty()) options.pilot = chip::chip_pilot(o.chip);
  return drive_one(scenario, options, {o.trace, o.svg, o.html, o.json});
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
  add_file(*cmd, "--html", o->html, "Write a page that replays the run in a browser");
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object and nothing else");
  cmd->add_option("--chip", o->chip,
                  "Let the core behind this shell command drive, such as\n\"scripts/chip cortex-m3\"")
      ->type_name("COMMAND");
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
