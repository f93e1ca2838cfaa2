/// Memory of every grid of the look-up, and its error against exact inference.
#pragma once

#include <string>

#include "firmware/fuzzy/variables.hpp"

namespace whisker::tools {

/// Markdown table rows, one per grid; errors are maxima over all inputs.
std::string grid_report(const fuzzy::RuleBase& rules);

}  // namespace whisker::tools
