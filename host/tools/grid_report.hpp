/// What every grid of the look-up costs and how far it is off exact inference.
#pragma once

#include <string>

#include "firmware/fuzzy/variables.hpp"

namespace whisker::tools {

/// Markdown table rows, one grid a row, and the closed form; errors are the largest of all inputs.
std::string grid_report(const fuzzy::RuleBase& rules);

}  // namespace whisker::tools
