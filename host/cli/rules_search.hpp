#pragma once

#include "host/cli/cli11_forward.hpp"

namespace whisker::cli {

/// `whisker rules search`.
void add_rules_search(CLI::App& rules, int& status);

}  // namespace whisker::cli
