/// A compiled rule base as a page for a browser: what it says, what a user should know, and its table to ask.
#pragma once

#include <string>
#include <vector>

#include "host/lab/rules/compile.hpp"
#include "host/lab/rules/surface.hpp"

namespace whisker::rules {

/// SVG. The surface must be of this rule base.
std::string picture(const RuleBase& base, const Surface& surface);

/// One self-contained HTML file. It computes answers as a chip does, from the table's integers.
std::string page(const Compiled& compiled);

}  // namespace whisker::rules
