#include <CLI/CLI.hpp>

#include "host/bench/param_client.hpp"
#include "host/cli/bench_commands.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"

namespace whisker::cli {

int bench_status(const std::function<int()>& run) {
  try {
    return run();
  } catch (const bench::Interrupted&) {
    return kInterrupted;
  }
}

void add_bench(CLI::App& app, int& status) {
  CLI::App* bench = app.add_subcommand("bench", "Look at a real robot on its bus, and set its parameters");
  bench->require_subcommand(1);
  add_bench_nodes(*bench, status);
  add_bench_watch(*bench, status);
  add_bench_params(*bench, status);
  add_bench_rules(*bench, status);
  add_bench_orders(*bench, status);
  add_bench_drive(*bench, status);
  add_bench_calibrate(*bench, status);
  for (CLI::App* command : bench->get_subcommands({})) {
    command->footer(
        R"(Exit status of bench: 0 done, 2 bad input or usage, or a value that is refused, 130 interrupted,
1 no answer, or anything else.)");
  }
}

}  // namespace whisker::cli
