#include "host/cli/rules_choice.hpp"

#include <cmath>
#include <filesystem>
#include <list>
#include <memory>
#include <stdexcept>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "firmware/fuzzy/engine.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "firmware/fuzzy/rules.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/lab/rules/read.hpp"

namespace whisker::cli {
namespace {

using namespace fuzzy;

double value(Q7 x) { return x.raw() / 128.0; }
double value(Q14 x) { return x.raw() / 16384.0; }
Q7 q7(double x) { return Q7::from_raw(static_cast<std::int16_t>(std::lround(x * 128))); }

report::Variable input(const char* symbol, const char* meaning, double min, double max,
                       const char* const (&names)[kTerms], const std::int16_t (&centres)[kTerms]) {
  report::Variable v{symbol, meaning, min, max, {}};
  for (int i = 0; i < kTerms; ++i) v.terms.push_back({names[i], value(Q7::from_raw(centres[i]))});
  return v;
}

std::string term_of(const report::Variable& v, double x) {
  for (const report::Term& t : v.terms) {
    if (t.centre == x) return t.name;
  }
  return {};
}

std::vector<std::vector<report::Rule>> picture_of(const Q14 (&rules)[kTerms][kTerms],
                                                  const report::Variable& v) {
  std::vector<std::vector<report::Rule>> rows;
  for (const auto& line : rules) {
    std::vector<report::Rule>& row = rows.emplace_back();
    for (const Q14 q : line) row.push_back({term_of(v, value(q)), value(q)});
  }
  return rows;
}

RuleBase answers_at_centres(const Engine::Table& table) {
  RuleBase rules{};
  for (int d = 0; d < kTerms; ++d) {
    for (int r = 0; r < kTerms; ++r) {
      const Response answer =
          Engine(table)({Q7::from_raw(kDistanceCentres[d]), Q7::from_raw(kBiasCentres[r])});
      rules.turn[d][r] = answer.turn;
      rules.step[d][r] = answer.step;
    }
  }
  return rules;
}

std::string engine_name() {
  return fmt::format("bilinear table of {} x {} nodes, {} bytes", Engine::kDistanceNodes, Engine::kBiasNodes,
                     sizeof(Engine::Table));
}

/// The boundaries of the engine's cells.
void add_nodes(report::FuzzyPicture& p) {
  const auto node = [](int low, int spacing, int i) { return (low + spacing * i) / 128.0; };
  for (int i = 0; i < Engine::kDistanceNodes; ++i)
    p.d_nodes.push_back(node(kDistanceLow, Engine::kDistanceSpacing, i));
  for (int i = 0; i < Engine::kBiasNodes; ++i) p.r_nodes.push_back(node(kBiasLow, Engine::kBiasSpacing, i));
}

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

report::FuzzyPicture controller_picture(const Engine::Table& table) {
  using namespace turn_terms;
  using namespace step_terms;
  report::FuzzyPicture p;
  p.d = input("D", "distance to the obstacles ahead", 0, 10, {"VS", "S", "M", "B", "VB"}, kDistanceCentres);
  p.r =
      input("R", "right distance minus left distance", -8, 8, {"RVB", "RB", "CE", "LB", "LVB"}, kBiasCentres);
  p.sa = {"SA",
          "turn factor, positive: turn left",
          -1.5,
          1.5,
          {{"TRVB", value(TRVB)},
           {"TRB", value(TRB)},
           {"Z", value(Z)},
           {"TLB", value(TLB)},
           {"TLVB", value(TLVB)}}};
  p.sd = {"SD",
          "step factor",
          0,
          2,
          {{"VS", value(VS)}, {"S", value(S)}, {"M", value(M)}, {"B", value(B)}, {"VB", value(VB)}}};
  const bool own = &table == &kDefaultTable;
  const RuleBase rules = own ? kRules : answers_at_centres(table);
  p.turn = picture_of(rules.turn, p.sa);
  p.step = picture_of(rules.step, p.sd);
  const auto at = [&table](double d, double r) { return Engine(table)({q7(d), q7(r)}); };
  p.sa_at = [at](double d, double r) { return value(at(d, r).turn); };
  p.sd_at = [at](double d, double r) { return value(at(d, r).step); };
  add_nodes(p);
  p.source = engine_name();
  return p;
}

rules::RuleBase load_rules(const std::string& file) {
  rules::RuleBase base = rules::read_rules(file);
  for (const std::string& warning : base.warnings) fmt::print(stderr, "whisker: {}\n", warning);
  return base;
}

const fuzzy::Engine::Table* response_table(const std::string& file_or_default,
                                           const std::vector<std::string>& names) {
  if (file_or_default == "default") return &fuzzy::kDefaultTable;
  static std::list<fuzzy::Engine::Table> tables;
  return &tables.emplace_back(named_response(load_rules(file_or_default), names).table);
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
  if (kind.table_chosen && kind != PlannerKind::thesis) robot.boundary.bend = Fitted::yes;
}

std::optional<std::string> rules_name(PlannerKind kind) {
  if (is_baseline(kind)) return std::nullopt;
  return fmt::format("{:08x}", rules_digest(kind));
}

report::FuzzyPicture controller_picture(PlannerKind kind) { return controller_picture(*kind.table); }

}  // namespace whisker::cli
