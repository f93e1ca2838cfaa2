#pragma once

#include "host/cli/cli11_forward.hpp"

namespace whisker::cli {

/// `whisker rules compare`.
void add_rules_compare(CLI::App& rules, int& status);

}  // namespace whisker::cli
