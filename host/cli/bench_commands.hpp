/// One function per subcommand of `whisker bench`.
#pragma once

#include <functional>

#include "host/cli/cli11_forward.hpp"

namespace whisker::cli {

void add_bench_calibrate(CLI::App& bench, int& status);
void add_bench_drive(CLI::App& bench, int& status);
void add_bench_nodes(CLI::App& bench, int& status);
void add_bench_orders(CLI::App& bench, int& status);
void add_bench_params(CLI::App& bench, int& status);
void add_bench_rules(CLI::App& bench, int& status);
void add_bench_watch(CLI::App& bench, int& status);

/// The status of `run`; kInterrupted after an interruption.
int bench_status(const std::function<int()>& run);

}  // namespace whisker::cli
