#pragma once

#include "host/cli/cli11_forward.hpp"

namespace whisker::cli {

/// `whisker rules table`.
CLI::App* add_rules_table(CLI::App& rules, int& status);

}  // namespace whisker::cli
