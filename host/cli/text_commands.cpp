#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "firmware/can/ids.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/figures.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/scenario/write.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/lab/protocol/page.hpp"
#include "host/lab/report/table_svg.hpp"

namespace whisker::cli {
namespace {

struct ResponseOptions {
  bool csv = false, json = false;
  std::string svg, file, out;
  std::vector<std::string> names;
};

/// In steps of a quarter unit, over the full range of both inputs.
void print_csv(const report::FuzzyPicture& p) {
  fmt::print("d,r,sa,sd\n");
  for (int d = 0; d <= 40; ++d) {
    for (int r = -32; r <= 32; ++r) {
      fmt::print("{:.2f},{:.2f},{:.5f},{:.5f}\n", d / 4.0, r / 4.0, p.sa_at(d / 4.0, r / 4.0),
                 p.sd_at(d / 4.0, r / 4.0));
    }
  }
}

void print_rules(const report::FuzzyPicture& p, const report::Variable& out,
                 const std::vector<std::vector<report::Rule>>& rules) {
  fmt::print("{} = {}\n{:>10}", out.symbol, out.meaning, "D \\ R");
  for (const report::Term& t : p.r.terms) fmt::print("{:>12}", fmt::format("{} {:g}", t.name, t.centre));
  fmt::print("\n");
  for (std::size_t d = 0; d < rules.size(); ++d) {
    fmt::print("{:>10}", fmt::format("{} {:g}", p.d.terms[d].name, p.d.terms[d].centre));
    for (const report::Rule& rule : rules[d])
      fmt::print("{:>12}", fmt::format("{} {:.2f}", rule.term, rule.value));
    fmt::print("\n");
  }
  fmt::print("\n");
}

int execute(const ResponseOptions& o) {
  check_outputs({o.svg, o.out}, {o.file}, o.csv || (o.json && o.out.empty()));
  if (o.json) return write_table(o.file, o.names, o.out);
  if (!o.out.empty()) throw UsageError("--out needs --json");
  const report::FuzzyPicture picture =
      o.file.empty() ? controller_picture() : controller_picture(*response_table(o.file, o.names));
  if (!o.svg.empty()) files::write(o.svg, report::table_svg(picture));
  if (o.csv) {
    print_csv(picture);
  } else if (o.svg != "-") {
    fmt::print("The 25 rules of the control response table ({}).\n\n", picture.source);
    print_rules(picture, picture.sa, picture.turn);
    print_rules(picture, picture.sd, picture.step);
    if (!o.svg.empty()) fmt::print("picture: {}\n", o.svg);
  }
  return 0;
}

struct WorldOptions {
  std::string kind;
  worlds::Options world;
  std::string out;
};

std::string generated(const WorldOptions& o) {
  try {
    return to_toml(worlds::generate(*worlds::kind_named(o.kind), o.world));
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

int execute(const WorldOptions& o) {
  check_outputs({o.out});
  const std::string text = generated(o);
  if (o.out.empty()) {
    fmt::print("{}", text);
  } else {
    files::write(o.out, text);
  }
  return 0;
}

}  // namespace

void add_table(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("table", "Show the control response table");
  const auto o = std::make_shared<ResponseOptions>();
  add_file(
      *cmd, "FILE", o->file,
      "Rule base (.fis, .fll, .fcl, .toml) with\ninputs D and R, outputs SA and SD; by default the core's");
  add_map_names(*cmd, o->names, "The file's name of D, R, SA or SD; may be repeated");
  add_switch(*cmd, "--csv", o->csv, "Print SA and SD over D and R, every quarter of a unit");
  add_switch(*cmd, "--json", o->json, "Print the table as JSON, for the playground");
  add_file(*cmd, "--out", o->out, "With --json: file to write, instead of standard output");
  add_file(*cmd, "--svg", o->svg, "Draw both outputs as heat maps with the rules on them");
  cmd->callback([o, &status] { status = execute(*o); });
}

void add_world(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("world", "Make a random scenario file");
  const auto o = std::make_shared<WorldOptions>();
  cmd->add_option("KIND", o->kind,
                  "discs, poles, u-trap, spiral, maze, rooms, enclosed,\nenclosed-at-wall, gap-at-wall, "
                  "contest-maze, gap or disc-gap")
      ->required()
      ->check([](const std::string& text) {
        std::vector<std::string_view> kinds;
        for (const worlds::Kind kind : worlds::kAllKinds) kinds.emplace_back(name(kind));
        return worlds::kind_named(text) ? "" : fmt::format("no kind '{}'{}", text, did_you_mean(text, kinds));
      });
  whole_number(
      cmd->add_option("--seed", o->world.seed, "The same seed gives the same world everywhere")->required(),
      "N");
  whole_number(cmd->add_option("--discs", o->world.discs, "Number of discs; 30 by default for kind discs"),
               "N", 200);
  add_gap_width(*cmd, o->world.gap_m, "Of the gap, 0.16 to 1 m; 0.32 by default (kinds gap, disc-gap)");
  add_switch(*cmd, "--box", o->world.box, "A closed box around it (kinds discs, poles, enclosed)");
  add_switch(*cmd, "--noise", o->world.noise, "With the reference robot's sensor noise and odometry error");
  add_wheel_scale_sigma(*cmd, o->world.wheel_scale_sigma,
                        "With --noise: scale error of the wheels, instead of 0.0001");
  add_file(*cmd, "--out", o->out, "File to write, instead of standard output");
  cmd->callback([o, &status] { status = execute(*o); });
}

struct ProtocolOptions {
  bool params = false, dbc = false;
  int robot = 1;
  FiguresOptions figures;
};

void add_protocol(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("protocol", "Print the CAN protocol, or another part of docs/");
  const auto o = std::make_shared<ProtocolOptions>();
  add_switch(*cmd, "--dbc", o->dbc, "As a DBC file");
  within(cmd->add_option("--robot", o->robot, "With --dbc: whose identifiers, 1 to 7"), "N", 1,
         static_cast<int>(can::kRobots));
  cmd->add_flag("--parameters", o->params, "The robot's parameters in the units of a scenario file instead");
  add_file(*cmd, "--figures", o->figures.out, "Draw the figures of docs/ anew, into this folder, instead")
      ->type_name("FOLDER");
  add_file(*cmd, "--scenarios", o->figures.scenarios, "Folder of other scenario files for figures 8 to 10");
  cmd->callback([o, &status] {
    status = 0;
    if (!o->figures.out.empty()) {
      status = draw_figures(o->figures);
    } else {
      fmt::print("{}", o->dbc      ? protocol::dbc(static_cast<std::uint8_t>(o->robot))
                       : o->params ? params_markdown()
                                   : protocol::page());
    }
  });
}

}  // namespace whisker::cli
