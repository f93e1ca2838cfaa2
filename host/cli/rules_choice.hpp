/// --rules: another response table for the planners of the core.
#pragma once

#include <optional>
#include <string>

#include "host/cli/cli11_forward.hpp"
#include "host/report/fuzzy_picture.hpp"
#include "host/run/planners.hpp"

namespace whisker::cli {

/// --rules FILE and --map CORE=NAME. After parsing, `kind` has the table of the file, which lives as long as
/// the program. Throws UsageError or InputError if the file is no such table or the planner has none.
void add_rules_choice(CLI::App& app, PlannerKind& kind);

/// Eight hex digits that name the response table; none: the planner has no table.
std::optional<std::string> rules_digest(PlannerKind kind);

/// The planner's response table, for pictures.
report::FuzzyPicture controller_picture(PlannerKind kind);

}  // namespace whisker::cli
