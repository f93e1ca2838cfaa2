/// --rules: another response table for the planners of the core.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "firmware/fuzzy/bilinear.hpp"
#include "firmware/fuzzy/engine.hpp"
#include "host/cli/cli11_forward.hpp"
#include "host/harness/run/planners.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/lab/report/fuzzy_picture.hpp"
#include "host/lab/rules/response.hpp"

namespace whisker::cli {

/// The core's engine with a response table, for the pictures. For another table than the core's own, the
/// rules are its answers at the centres of the terms.
report::FuzzyPicture controller_picture(const fuzzy::Engine::Table& table = fuzzy::kDefaultTable);

/// A rule base; prints its warnings on standard error. Throws InputError.
rules::RuleBase load_rules(const std::string& file);

/// The table of a rule base, or of the core for the word "default"; it lives as long as the program. Throws
/// UsageError or InputError.
const fuzzy::Engine::Table* response_table(const std::string& file_or_default,
                                           const std::vector<std::string>& names);

/// Loads the rule bases of the scenario's events; their paths are relative to the scenario file's folder.
/// Throws InputError.
void load_event_tables(Scenario& scenario, const std::string& file);

/// The response to a rule base with these names, CORE=NAME. Throws UsageError or InputError.
rules::Response named_response(const rules::RuleBase& base, const std::vector<std::string>& names);

/// --rules FILE and --map CORE=NAME. After parsing, `table` is that of the assist, or null if no file is
/// given. Throws UsageError or InputError.
CLI::Option* add_assist_rules(CLI::App& app, const fuzzy::Bilinear::Table*& table);

/// --map CORE=NAME.
void add_map_names(CLI::App& app, std::vector<std::string>& names, const std::string& help);

/// --rules FILE and --map CORE=NAME. After parsing, `kind` has the table, chosen. Throws UsageError or
/// InputError if the file is no such table or the planner has none. Returns --rules.
CLI::Option* add_rules_choice(CLI::App& app, PlannerKind& kind, const std::string& help);

/// Whoever chooses a table wants to drive with it: sets bend_course, whatever the files say, if the planner's
/// table is chosen and its turns need that parameter. For commands that own the robot's parameters.
void bend_if_chosen(Params& robot, PlannerKind kind);

/// Eight hex digits that name the response table; none: the planner has no table.
std::optional<std::string> rules_name(PlannerKind kind);

/// The planner's response table, for pictures.
report::FuzzyPicture controller_picture(PlannerKind kind);

}  // namespace whisker::cli
