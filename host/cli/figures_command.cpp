#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "host/cli/commands.hpp"
#include "host/cli/controller_picture.hpp"
#include "host/cli/exit_status.hpp"
#include "host/report/figures.hpp"
#include "host/report/file.hpp"
#include "host/report/run_svg.hpp"
#include "host/run/runner.hpp"
#include "host/scenario/load.hpp"

namespace whisker::cli {
namespace {

struct Options {
  std::string scenarios = "host/worlds/scenarios";
  std::string out;
};

void draw_run(const std::string& scenario_file, const std::string& svg_file) {
  const Scenario scenario = load_scenario(scenario_file);
  std::vector<TickRecord> records;
  RunOptions options;
  options.records = &records;
  const RunResult result = run(scenario, options);
  report::write_file(svg_file, report::run_svg(scenario, records, result));
  fmt::print("{}\n", svg_file);
}

int execute(const Options& o) {
  if (!std::filesystem::is_directory(o.out)) throw UsageError(fmt::format("{}: no such folder", o.out));
  for (const auto& [file, svg] : report::thesis_figures(controller_picture())) {
    const std::string path = fmt::format("{}/{}", o.out, file);
    report::write_file(path, svg);
    fmt::print("{}\n", path);
  }
  draw_run(o.scenarios + "/figure8_u_trap.toml", o.out + "/figure8.svg");
  draw_run(o.scenarios + "/figure9_discs.toml", o.out + "/figure9.svg");
  draw_run(o.scenarios + "/figure10_discs.toml", o.out + "/figure10.svg");
  return 0;
}

}  // namespace

void add_figures(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("figures", "Draw the figures of docs/figures.md anew");
  const auto o = std::make_shared<Options>();
  cmd->add_option("FOLDER", o->out, "Where to write figure2.svg to figure10.svg")->required();
  cmd->add_option("--scenarios", o->scenarios, "Folder of the scenario files")->capture_default_str();
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
