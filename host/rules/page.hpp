/// A compiled rule base as a page for a browser: what it says, what a user should know, and its table to ask.
#pragma once

#include <string>

#include "host/rules/compile.hpp"

namespace whisker::rules {

/// One self-contained HTML file. It computes answers as a chip does, from the table's integers.
std::string page(const Compiled& compiled);

}  // namespace whisker::rules
