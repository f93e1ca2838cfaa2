#include <memory>
#include <string>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/chip/chip_pilot.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/one_run.hpp"
#include "host/cli/options.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/cli/scenario_options.hpp"

namespace whisker::cli {
namespace {

struct RunCommandOptions {
  ScenarioChoice scenario;
  PlannerKind planner = kDefaultPlanner;
  std::string chip;
};

int execute(const RunCommandOptions& o) {
  if (!o.chip.empty() && is_baseline(o.planner)) {
    throw UsageError(fmt::format("--chip: planner {} runs on this computer only", name(o.planner)));
  }
  if (!o.chip.empty() && o.planner.table != &fuzzy::kDefaultTable)
    throw UsageError(
        "--chip: the core behind it has a response table of its own; --rules does not go with it");
  Scenario scenario = o.scenario.load();
  bend_if_chosen(scenario.robot, o.planner);
  RunOptions options = o.scenario.run_options();
  options.planner = o.planner;
  if (!o.chip.empty()) options.pilot = chip::chip_pilot(o.chip);
  try {
    return drive_one(scenario, options, o.scenario.run_outputs(scenario));
  } catch (const chip::NoRoom& e) {
    throw UsageError(e.what());
  }
}

}  // namespace

void add_run(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("run", "Drive the simulated robot through a scenario file");
  const auto o = std::make_shared<RunCommandOptions>();
  add_scenario(*cmd, o->scenario);
  add_planner(*cmd, o->planner);
  cmd->add_option("--chip", o->chip,
                  "Let the core behind this shell command drive, such as\n\"scripts/chip cortex-m3\"")
      ->type_name("COMMAND");
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
