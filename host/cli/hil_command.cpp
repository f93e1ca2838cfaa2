#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "host/cli/bus_options.hpp"
#include "host/cli/bus_run.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/cli/scenario_options.hpp"

namespace whisker::cli {
namespace {

constexpr const char* kPrivate = "private";

struct HilOptions {
  ScenarioChoice scenario;
  BusChoice bus;
  ViewChoice view;
  PlannerKind planner = kDefaultPlanner;
};

/// The controller in a separate process; it ends with this object or with this process.
class ControllerProcess {
 public:
  template <class F>
  explicit ControllerProcess(const F& control) {
    std::fflush(nullptr);
    const pid_t parent = getpid();
    child_ = fork();
    if (child_ < 0) throw std::runtime_error("no process for the controller");
    if (child_ > 0) return;
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    int status = 1;
    try {
      if (getppid() == parent) control();
      status = 0;
    } catch (const std::exception& e) {
      std::fprintf(stderr, "whisker: %s\n", e.what());
    }
    _exit(status);
  }
  ~ControllerProcess() {
    kill(child_, SIGTERM);
    waitpid(child_, nullptr, 0);
  }
  ControllerProcess(const ControllerProcess&) = delete;
  ControllerProcess& operator=(const ControllerProcess&) = delete;

 private:
  pid_t child_ = -1;
};

/// As a controller that was started without --rules: the base sends them.
PlannerKind with_own_table(PlannerKind kind) {
  kind.table = &fuzzy::kDefaultTable;
  return kind;
}

int execute(const HilOptions& o) {
  Scenario scenario = o.scenario.load({o.bus.record});
  bend_if_chosen(scenario.robot, o.planner);
  BusChoice controller = o.bus;
  controller.record.clear();
  controller.drop_percent = 0;
  const bool is_private = o.bus.name == kPrivate;
  if (o.bus.name.rfind("slcan:", 0) == 0) throw UsageError("hil: a serial line has one end here; see plant");
  const auto view = o.view.open(o.planner);
  auto lines =
      is_private ? hil::private_lines() : std::pair{hil::open_line(o.bus.name), hil::open_line(o.bus.name)};
  const ControllerProcess child([&] {
    if (view) view->abandon();
    lines.first.reset();
    control_on_bus(controller, with_own_table(o.planner), *lines.second);
  });
  lines.second.reset();
  RunOptions options = o.scenario.run_options();
  options.planner = o.planner;
  BusChoice base = o.bus;
  if (!is_baseline(o.planner)) base.drive_with(o.planner);
  return drive_on_bus(scenario, options, o.scenario.run_outputs(scenario), base, *lines.first, view.get());
}

}  // namespace

void add_hil(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("hil", "Plant and controller in two processes on a CAN bus");
  const auto o = std::make_shared<HilOptions>();
  o->bus.name = kPrivate;
  add_scenario(*cmd, o->scenario);
  add_bus(*cmd, o->bus)
      ->description(
          "CAN interface, such as vcan0; \"private\": a bus of their own, which\n"
          "needs no CAN on this computer")
      ->capture_default_str();
  add_planner(*cmd, o->planner);
  add_switch(*cmd, "--realtime", o->bus.real_time, "A tick each period, instead of waiting for each answer");
  add_view(*cmd, o->view);
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
