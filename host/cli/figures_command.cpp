#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "host/cli/commands.hpp"
#include "host/cli/controller_picture.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/report/figures.hpp"
#include "host/report/file.hpp"
#include "host/report/run_svg.hpp"
#include "host/report/table_svg.hpp"
#include "host/run/runner.hpp"
#include "host/scenario/load.hpp"

namespace whisker::cli {
namespace {

struct Options {
  std::string scenarios = "host/worlds/scenarios";
  std::string out;
};

void draw_run(const Scenario& scenario, const std::string& svg_file) {
  std::vector<TickRecord> records;
  RunOptions options;
  options.records = &records;
  options.planner = PlannerKind::thesis;
  const RunResult result = run(scenario, options);
  report::write_file(svg_file, report::run_svg(scenario, records, result));
  fmt::print("{}\n", svg_file);
}

int execute(const Options& o) {
  if (!std::filesystem::is_directory(o.out)) throw UsageError(fmt::format("{}: no such folder", o.out));
  const Scenario figure8 = load_scenario(o.scenarios + "/figure8_u_trap.toml");
  const Scenario figure9 = load_scenario(o.scenarios + "/figure9_discs.toml");
  const Scenario figure10 = load_scenario(o.scenarios + "/figure10_discs.toml");
  const report::FuzzyPicture picture = controller_picture();
  auto drawn = report::thesis_figures(picture);
  drawn.emplace_back("response.svg", report::table_svg(picture));
  for (const auto& [file, svg] : drawn) {
    const std::string path = fmt::format("{}/{}", o.out, file);
    report::write_file(path, svg);
    fmt::print("{}\n", path);
  }
  draw_run(figure8, o.out + "/figure8.svg");
  draw_run(figure9, o.out + "/figure9.svg");
  draw_run(figure10, o.out + "/figure10.svg");
  return 0;
}

}  // namespace

void add_figures(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("figures", "Draw the figures of docs/figures.md anew");
  const auto o = std::make_shared<Options>();
  add_file(*cmd, "FOLDER", o->out, "Where to write figure2.svg to figure10.svg and response.svg")
      ->required()
      ->type_name("FOLDER");
  add_file(*cmd, "--scenarios", o->scenarios, "Folder of the scenario files")->capture_default_str();
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
