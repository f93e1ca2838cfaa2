#include "host/cli/one_run.hpp"

#include <chrono>
#include <memory>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/scenario/contact.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/lab/page/page.hpp"
#include "host/lab/report/result.hpp"
#include "host/lab/report/run_svg.hpp"
#include "host/lab/report/trace.hpp"

namespace whisker::cli {
namespace {

RunResult with_progress(const Scenario& scenario, RunOptions& options, const RunOutputs& outputs) {
  ProgressLine line;
  auto last = std::chrono::steady_clock::now();
  options.progress = [&](double time_s, double distance_m) {
    const auto now = std::chrono::steady_clock::now();
    if (now - last < std::chrono::milliseconds(200)) return;
    last = now;
    line.show(fmt::format("{:.0f} s of at most {:.0f} s simulated, {:.2f} m from the goal{}{}", time_s,
                          scenario.time_limit_s, distance_m, outputs.bus_words ? ", " : "",
                          outputs.bus_words ? outputs.bus_words() : ""));
  };
  return run(scenario, options);
}

/// The picture's title includes the size of the map.
report::RunPicture picture(const RunLog& log, PlannerKind planner) {
  report::RunPicture picture;
  if (log.map()) picture.subtitle = fmt::format("map planner, {} bytes", planner.map_bytes);
  return picture;
}

Provenance provenance(const Scenario& scenario, const RunOptions& options, const RunOutputs& outputs) {
  Provenance p;
  p.seed = options.seed.value_or(scenario.seed);
  if (outputs.knows_planner) {
    p.planner = name(options.planner);
    p.rules_digest = rules_name(options.planner);
  }
  p.robot_name = outputs.robot_name;
  p.robot_digest = robot_digest(scenario.robot);
  return p;
}

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

RunSetting setting(const Scenario& scenario, const RunOptions& options, const RunOutputs& outputs) {
  const auto planner = outputs.knows_planner ? std::optional(options.planner) : std::nullopt;
  return {scenario, planner, options.seed.value_or(scenario.seed), outputs.inside};
}

int drive_one(const Scenario& scenario, RunOptions options, const RunOutputs& o) {
  RunLog log(setting(scenario, options, o));
  if (!(o.trace.empty() && o.svg.empty() && o.html.empty())) log.watch(options);
  const RunResult result = with_progress(scenario, options, o);
  log.end(result);
  if (o.ended) o.ended(result);
  if (!o.trace.empty()) report::write_trace(o.trace, log);
  if (!o.svg.empty()) files::write(o.svg, report::run_svg(log, picture(log, options.planner)));
  if (!o.html.empty())
    files::write(o.html, page::run_page(page::stored(log), controller_picture(options.planner)));

  for (const std::string& warning :
       {start_warning(scenario),
        result.ranges ? report::range_warning(*result.ranges, scenario) : std::string()}) {
    if (!warning.empty()) fmt::print(stderr, "whisker: {}\n", warning);
  }
  if (o.json) {
    const std::string json = report::result_json(result, o.bus_json ? o.bus_json() : "");
    fmt::print("{}\n", with_provenance(json, provenance(scenario, options, o)));
  } else {
    std::FILE* const out = words_beside({o.trace, o.svg, o.html, o.record});
    fmt::print(out, "{}\n{:.2f} m from the goal after {} ticks, command hash {:016x}\n",
               report::verdict_words(result), result.final_distance_m, result.ticks, result.hash);
    if (result.events)
      fmt::print(out, "events:  {} played, {} refused\n", result.events->played, result.events->refused);
    if (o.bus_words) fmt::print(out, "bus:     {}\n", o.bus_words());
    if (!o.trace.empty()) fmt::print(out, "trace:   {}\n", o.trace);
    if (!o.svg.empty()) fmt::print(out, "picture: {}\n", o.svg);
    if (!o.html.empty()) fmt::print(out, "page:    {}\n", o.html);
  }
  return exit_status(result.verdict);
}

Scenario ScenarioChoice::load(std::initializer_list<std::string> more_outputs) const {
  std::vector<std::string> all(more_outputs);
  all.push_back(outputs.trace);
  all.push_back(outputs.svg);
  all.push_back(outputs.html);
  check_outputs(all, {file, robot}, outputs.json);
  Scenario scenario = load_scenario(file, robot);
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
  whole_number(app.add_option("--seed", choice.seed, "Seed of the noise, instead of the scenario's"), "N");
  add_file(app, "--trace", choice.outputs.trace, "Write one CSV row per control tick");
  add_file(app, "--svg", choice.outputs.svg, "Draw the run");
  add_file(app, "--html", choice.outputs.html, "Write a page that replays the run in a browser");
  add_switch(app, "--json", choice.outputs.json, "Print the result as one JSON object and nothing else");
}

void add_run(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("run", "Drive the simulated robot through a scenario file");
  const auto o = std::make_shared<RunCommandOptions>();
  add_scenario(*cmd, o->scenario);
  add_planner(*cmd, o->planner);
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
