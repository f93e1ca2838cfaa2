/// firmware/fuzzy/response_table.hpp as text: the look-up table of a rule base, one line per row of D.
#pragma once

#include <string>

#include "firmware/fuzzy/variables.hpp"

namespace whisker::tools {

std::string response_table_text(const fuzzy::RuleBase& rules);

}  // namespace whisker::tools
