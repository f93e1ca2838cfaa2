#include "host/cli/rules_choice.hpp"

#include <filesystem>
#include <list>
#include <memory>
#include <stdexcept>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "firmware/fuzzy/response_table.hpp"
#include "host/cli/controller_picture.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/rules/read.hpp"

namespace whisker::cli {
namespace {

struct RulesChoice {
  std::string file;
  std::vector<std::string> names;
};

CLI::Option* add_options(CLI::App& app, RulesChoice& choice, const std::string& help) {
  CLI::Option* const rules = add_file(app, "--rules", choice.file, help);
  add_map_names(app, choice.names, "With --rules: the file's name of D, R, SA or SD; may be repeated");
  return rules;
}

bool given(const RulesChoice& choice) {
  if (choice.file.empty() && !choice.names.empty()) throw UsageError("--map needs --rules");
  return !choice.file.empty();
}

}  // namespace

const fuzzy::Engine::Table* response_table(const std::string& file_or_default,
                                           const std::vector<std::string>& names) {
  if (file_or_default == "default") return &fuzzy::kDefaultTable;
  static std::list<fuzzy::Engine::Table> tables;
  return &tables.emplace_back(named_response(rules::read_rules(file_or_default), names).table);
}

void load_event_tables(Scenario& scenario, const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  for (Event& event : scenario.events) {
    if (event.kind == EventKind::table && !event.file.empty())
      event.table = response_table((folder / event.file).string(), {});
  }
}

rules::Response named_response(const rules::RuleBase& base, const std::vector<std::string>& names) {
  try {
    return rules::response(base, rules::response_names(names));
  } catch (const std::invalid_argument& e) {
    throw UsageError(fmt::format("--map: {}", e.what()));
  }
}

void add_map_names(CLI::App& app, std::vector<std::string>& names, const std::string& help) {
  app.add_option("--map", names, help)->take_all()->allow_extra_args(false)->type_name("D=NAME");
}

CLI::Option* add_rules_choice(CLI::App& app, PlannerKind& kind, const std::string& help) {
  const auto choice = std::make_shared<RulesChoice>();
  CLI::Option* const rules = add_options(app, *choice, help);
  app.parse_complete_callback([choice, &kind] {
    if (!given(*choice)) return;
    if (is_baseline(kind)) throw UsageError(fmt::format("--rules: planner {} has no table", name(kind)));
    kind.table = response_table(choice->file, choice->names);
    kind.table_chosen = true;
  });
  return rules;
}

CLI::Option* add_assist_rules(CLI::App& app, const fuzzy::Bilinear::Table*& table) {
  const auto choice = std::make_shared<RulesChoice>();
  CLI::Option* const rules =
      add_options(app, *choice, "Response table of the assist from this rule base, see docs/rules.md");
  app.parse_complete_callback([choice, &table] {
    if (given(*choice)) table = response_table(choice->file, choice->names);
  });
  return rules;
}

void bend_if_chosen(Params& robot, PlannerKind kind) {
  if (kind.table_chosen && kind != PlannerKind::thesis) robot.skirt.bend = Fitted::yes;
}

std::optional<std::string> rules_name(PlannerKind kind) {
  if (is_baseline(kind)) return std::nullopt;
  return fmt::format("{:08x}", rules_digest(kind));
}

report::FuzzyPicture controller_picture(PlannerKind kind) { return controller_picture(*kind.table); }

}  // namespace whisker::cli
