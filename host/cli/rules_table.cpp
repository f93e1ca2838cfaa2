#include "host/cli/rules_table.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "firmware/fuzzy/digest.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/report/file.hpp"
#include "host/rules/read.hpp"

namespace whisker::cli {
namespace {

using fuzzy::Bilinear;
using Json = nlohmann::ordered_json;

/// Of the file format; the playground refuses others (host/web/src/playground/opened_table.ts).
constexpr int kFormat = 1;

struct TableOptions {
  std::string file;
  std::vector<std::string> names;
  std::string out;
};

std::string json_of(const rules::RuleBase& base, const rules::Response& response) {
  std::vector<std::int16_t> nodes;
  for (const auto& row : response.table.node)
    for (const Bilinear::Node& node : row) nodes.insert(nodes.end(), {node.turn, node.step});
  const Json json = {
      {"whisker_table", kFormat},
      {"name", base.name.empty() ? std::filesystem::path(base.file).filename().string() : base.name},
      {"hash", fmt::format("{:08x}", fuzzy::digest(response.table))},
      {"rows", Bilinear::kDistanceNodes},
      {"columns", Bilinear::kBiasNodes},
      {"symmetric", response.symmetric},
      {"turn_error", response.turn_error},
      {"step_error", response.step_error},
      {"nodes", nodes}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

int execute(const TableOptions& o) {
  check_outputs({o.out}, {o.file});
  const rules::RuleBase base = rules::read_rules(o.file);
  const std::string text = json_of(base, named_response(base, o.names));
  if (o.out.empty()) {
    fmt::print("{}", text);
  } else {
    report::write_file(o.out, text);
    fmt::print(words_beside({o.out}), "table: {}\n", o.out);
  }
  return 0;
}

}  // namespace

CLI::App* add_rules_table(CLI::App& rules, int& status) {
  CLI::App* cmd =
      rules.add_subcommand("table", "Write the core's response table of a rule base, for the playground");
  const auto o = std::make_shared<TableOptions>();
  add_file(*cmd, "FILE", o->file,
           "Rule base (.fis, .fll, .fcl, .toml) with\ninputs D and R, outputs SA and SD")
      ->required();
  add_map_names(*cmd, o->names, "The file's name of D, R, SA or SD; may be repeated");
  add_file(*cmd, "--out", o->out, "File to write (JSON), instead of standard output");
  cmd->callback([o, &status] { status = execute(*o); });
  return cmd;
}

}  // namespace whisker::cli
