/// One function per subcommand: it declares its options and, if chosen, runs and sets `status`.
#pragma once

#include "host/cli/cli11_forward.hpp"

namespace whisker::cli {

void add_run(CLI::App& app, int& status);
void add_world(CLI::App& app, int& status);
void add_robot(CLI::App& app, int& status);
void add_robot_check(CLI::App& robot, int& status);
void add_robot_layout(CLI::App& robot, int& status);
void add_robot_list(CLI::App& robot, int& status);
void add_robot_calibrate(CLI::App& robot, int& status);
void add_robot_calibrate_drive(CLI::App& robot, int& status);
void add_campaign(CLI::App& app, int& status);
void add_guard(CLI::App& app, int& status);
void add_hunt(CLI::App& app, int& status);
void add_operators(CLI::App& app, int& status);
void add_movers(CLI::App& app, int& status);
void add_table(CLI::App& app, int& status);
void add_rules(CLI::App& app, int& status);
void add_rules_compare(CLI::App& rules, int& status);
void add_plant(CLI::App& app, int& status);
void add_bench(CLI::App& app, int& status);
void add_bench_calibrate(CLI::App& bench, int& status);
void add_bench_drive(CLI::App& bench, int& status);
void add_bench_orders(CLI::App& bench, int& status);
void add_bench_params(CLI::App& bench, int& status);
void add_bench_rules(CLI::App& bench, int& status);
void add_bench_selftest(CLI::App& bench, int& status);
void add_bench_watch(CLI::App& bench, int& status);
void add_socket(CLI::App& app, int& status);
void add_controller(CLI::App& app, int& status);
void add_hil(CLI::App& app, int& status);
void add_replay(CLI::App& app, int& status);
void add_protocol(CLI::App& app, int& status);

}  // namespace whisker::cli
