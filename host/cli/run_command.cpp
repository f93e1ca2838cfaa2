#include <memory>

#include <CLI/CLI.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/one_run.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/cli/scenario_options.hpp"

namespace whisker::cli {
namespace {

struct RunCommandOptions {
  ScenarioChoice scenario;
  PlannerKind planner = kDefaultPlanner;
};

int execute(const RunCommandOptions& o) {
  Scenario scenario = o.scenario.load();
  bend_if_chosen(scenario.robot, o.planner);
  RunOptions options = o.scenario.run_options();
  options.planner = o.planner;
  return drive_one(scenario, options, o.scenario.run_outputs(scenario));
}

}  // namespace

void add_run(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("run", "Drive the simulated robot through a scenario file");
  const auto o = std::make_shared<RunCommandOptions>();
  add_scenario(*cmd, o->scenario);
  add_planner(*cmd, o->planner);
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
