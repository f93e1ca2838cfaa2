#include "host/cli/scenario_options.hpp"

#include <vector>

#include <CLI/CLI.hpp>

#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/scenario/load.hpp"

namespace whisker::cli {

Scenario ScenarioChoice::load(std::initializer_list<std::string> more_outputs) const {
  std::vector<std::string> all(more_outputs);
  all.push_back(outputs.trace);
  all.push_back(outputs.svg);
  all.push_back(outputs.html);
  check_outputs(all, {file, robot}, outputs.json);
  Scenario scenario = load_scenario(file);
  if (!robot.empty()) apply_robot_file(scenario, robot);
  load_event_tables(scenario, file);
  return scenario;
}

RunOutputs ScenarioChoice::run_outputs(const Scenario& scenario) const {
  RunOutputs all = outputs;
  all.robot_name = robot_name(scenario.robot, robot, file);
  return all;
}

RunOptions ScenarioChoice::run_options() const {
  RunOptions options;
  options.seed = seed;
  return options;
}

void add_scenario(CLI::App& app, ScenarioChoice& choice) {
  add_file(app, "SCENARIO", choice.file, "Scenario file (TOML)")->required();
  add_file(app, "--robot", choice.robot, "Parameters of your robot (TOML), over those of the scenario");
  app.add_option("--seed", choice.seed, "Seed of the noise, instead of the scenario's")
      ->transform(whole_number())
      ->type_name("N");
  add_file(app, "--trace", choice.outputs.trace, "Write one CSV row per control tick");
  add_file(app, "--svg", choice.outputs.svg, "Draw the run");
  add_file(app, "--html", choice.outputs.html, "Write a page that replays the run in a browser");
  add_switch(app, "--json", choice.outputs.json, "Print the result as one JSON object and nothing else");
}

}  // namespace whisker::cli
