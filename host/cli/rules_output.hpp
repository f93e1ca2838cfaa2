/// What `whisker rules` prints.
#pragma once

#include <cstdio>
#include <string>

#include "host/rules/compile.hpp"

namespace whisker::cli {

/// The table for people: axes, bytes, errors, warnings.
void print_table(std::FILE* out, const rules::Compiled& compiled);

/// Variables with their terms, and the number of rules.
void print_rule_base(std::FILE* out, const rules::RuleBase& base);

/// What print_table() prints, as one JSON object.
std::string table_json(const rules::Compiled& compiled);

}  // namespace whisker::cli
