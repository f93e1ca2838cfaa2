#include <memory>

#include <CLI/CLI.hpp>

#include "host/cli/bus_options.hpp"
#include "host/cli/bus_run.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"

namespace whisker::cli {
namespace {

struct ControllerOptions {
  BusChoice bus;
  PlannerKind planner = kDefaultPlanner;
};

int execute(const ControllerOptions& o) {
  check_outputs({o.bus.record});
  const auto line = hil::open_line(o.bus.name);
  control_on_bus(o.bus, o.planner, *line);
  return 0;
}

}  // namespace

void add_controller(CLI::App& app, int& status) {
  CLI::App* cmd =
      app.add_subcommand("controller", "Put the firmware core on a CAN bus; it waits for missions");
  const auto o = std::make_shared<ControllerOptions>();
  add_bus(*cmd, o->bus)->required();
  add_planner(*cmd, o->planner);
  add_switch(*cmd, "--realtime", o->bus.real_time,
             "Be ready for a plant with --realtime: run before other processes");
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
