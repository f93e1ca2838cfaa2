#include <memory>
#include <string>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/controller_picture.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/report/file.hpp"
#include "host/report/table_svg.hpp"

namespace whisker::cli {
namespace {

struct TableOptions {
  bool csv = false;
  std::string svg;
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

int execute(const TableOptions& o) {
  check_outputs({o.svg}, {}, o.csv);
  const report::FuzzyPicture picture = controller_picture();
  if (!o.svg.empty()) report::write_file(o.svg, report::table_svg(picture));
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

}  // namespace

void add_table(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("table", "Show the control response table");
  const auto o = std::make_shared<TableOptions>();
  add_switch(*cmd, "--csv", o->csv, "Print SA and SD over D and R, every quarter of a unit");
  add_file(*cmd, "--svg", o->svg, "Draw both outputs as heat maps with the rules on them");
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
