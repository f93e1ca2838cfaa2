#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "firmware/calibration/store.hpp"
#include "firmware/can/limits.hpp"
#include "firmware/fuzzy/table_store.hpp"
#include "host/cli/bus_run.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/one_run.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/hil/file_storage.hpp"
#include "host/harness/hil/host_rules.hpp"

namespace whisker::cli {
namespace {

struct PlantOptions {
  ScenarioChoice scenario;
  BusChoice bus;
  ViewChoice view;
  PlannerKind wanted;
  const CLI::Option* rules = nullptr;
  std::string calibrate;
};

can::Order order_of(const PlantOptions& o) {
  if (o.calibrate.empty()) return can::Order::start;
  if (o.calibrate == "spin") return can::Order::spin;
  if (o.calibrate == "straight") return can::Order::straight;
  if (o.calibrate == "tape") return can::Order::tape;
  throw UsageError(fmt::format("--calibrate {}: spin, straight or tape{}", o.calibrate,
                               did_you_mean(o.calibrate, {"spin", "straight", "tape"})));
}

int execute(const PlantOptions& o) {
  const can::Order order = order_of(o);
  Scenario scenario = o.scenario.load({o.bus.record});
  bend_if_chosen(scenario.robot, o.wanted);
  const auto view = o.view.open();
  const auto line = hil::open_line(o.bus.name);
  RunOutputs outputs = o.scenario.run_outputs(scenario);
  outputs.knows_planner = false;
  BusChoice bus = o.bus;
  bus.order = order;
  if (o.rules->count() > 0) bus.drive_with(o.wanted);
  return drive_on_bus(scenario, o.scenario.run_options(), outputs, bus, *line, view.get());
}

struct ControllerOptions {
  BusChoice bus;
  PlannerKind planner = kDefaultPlanner;
  bool guard = false;
  double command_s = can::kVelocityLate_ms * 1e-3;
  std::string keep;
  std::string calibration;
};

/// What it is not used for would be lost with the next record.
void check_content(const char* option, const std::string& path, hal::Storage& storage) {
  fuzzy::Bilinear::Table table;
  bool has_table = false;
  calibration::Values values;
  const storage::Stored tables = fuzzy::TableStore(storage).load(table, has_table);
  const storage::Stored calibrations = calibration::Store(storage).load(values);
  const bool keeps = std::string_view(option) == "--keep";
  if ((keeps ? tables : calibrations) == storage::Stored::other_version)
    throw UsageError(
        fmt::format("{}: {}: another version of whisker has written it: name another file", option, path));
  if ((keeps ? calibrations : tables) != storage::Stored::nothing)
    throw UsageError(fmt::format("{}: {}: has a {}: name another file", option, path,
                                 keeps ? "calibration" : "response table"));
}

/// Null without a file.
std::unique_ptr<hil::FileStorage> open_file(const char* option, const std::string& path) {
  if (path.empty()) return nullptr;
  try {
    auto file = std::make_unique<hil::FileStorage>(path);
    check_content(option, path, *file);
    return file;
  } catch (const hil::FileStorageError& e) {
    throw UsageError(fmt::format("{}: {}", option, e.what()));
  }
}

std::unique_ptr<hil::FileStorage> open_storage(const ControllerOptions& o) {
  if (!o.keep.empty() && hil::table_to_send(o.planner) == nullptr) {
    throw UsageError(fmt::format("--keep: planner {} takes no table", name(o.planner)));
  }
  return open_file("--keep", o.keep);
}

int execute(const ControllerOptions& o) {
  check_outputs({o.bus.record});
  if (!o.keep.empty() && o.keep == o.calibration) throw UsageError("--keep and --calibration: two files");
  const auto storage = open_storage(o);
  const auto kept = open_file("--calibration", o.calibration);
  const auto line = hil::open_line(o.bus.name);
  const auto drive = [&](planning::Calibrator* calibrator) {
    if (o.guard) {
      guard_on_bus(o.bus, o.planner, o.command_s, *line);
    } else {
      control_on_bus(o.bus, o.planner, *line, storage.get(), calibrator);
    }
  };
  if (!kept) {
    drive(nullptr);
  } else {
    planning::Calibrator calibrator(*kept);
    drive(&calibrator);
  }
  return 0;
}

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
    if (child_ < 0) return;
    kill(child_, SIGTERM);
    waitpid(child_, nullptr, 0);
  }
  ControllerProcess(const ControllerProcess&) = delete;
  ControllerProcess& operator=(const ControllerProcess&) = delete;

  /// Throws std::runtime_error if it has ended.
  void check() {
    int status = 0;
    if (child_ < 0 || waitpid(child_, &status, WNOHANG) != child_) return;
    child_ = -1;
    throw std::runtime_error(
        WIFSIGNALED(status) ? fmt::format("the controller's process was ended by signal {}", WTERMSIG(status))
                            : "the controller's process has ended");
  }

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
  ControllerProcess child([&] {
    if (view) view->abandon();
    lines.first.reset();
    control_on_bus(controller, with_own_table(o.planner), *lines.second);
  });
  lines.second.reset();
  RunOptions options = o.scenario.run_options();
  options.planner = o.planner;
  BusChoice base = o.bus;
  base.beside = with_own_table(o.planner);
  if (!is_baseline(o.planner)) base.drive_with(o.planner);
  return drive_on_bus(scenario, options, o.scenario.run_outputs(scenario), base, *lines.first, view.get(),
                      [&] { child.check(); });
}

}  // namespace

void add_plant(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("plant", "Put the simulated robot on a CAN bus and give it a mission");
  const auto o = std::make_shared<PlantOptions>();
  add_scenario(*cmd, o->scenario);
  add_bus(*cmd, o->bus)->required();
  add_switch(*cmd, "--realtime", o->bus.real_time, "A tick each period, instead of waiting for each answer");
  o->rules = add_rules_choice(
      *cmd, o->wanted, "Send this rule base to the controller as its response table;\nsets bend_course");
  add_name(
      *cmd, "--calibrate", o->calibrate,
      "Order a calibration instead of a mission: spin, or for the\ndistance of the goal straight or tape")
      ->type_name("NAME");
  add_view(*cmd, o->view);
  cmd->callback([o, &status] { status = execute(*o); });
}

void add_controller(CLI::App& app, int& status) {
  CLI::App* cmd =
      app.add_subcommand("controller", "Put the firmware core on a CAN bus; it waits for missions");
  const auto o = std::make_shared<ControllerOptions>();
  add_bus(*cmd, o->bus)->required();
  CLI::Option* const planner = add_planner(*cmd, o->planner);
  CLI::Option* const guard = add_switch(
      *cmd, "--guard", o->guard,
      "The guard alone: an operator on the bus drives, such as\nwhisker bench drive; docs/guard.md");
  guard->excludes(planner);
  cmd->add_option("--command-timeout", o->command_s,
                  "With --guard: brake if no Velocity comes for so long, s;\n0.05 by default")
      ->transform(amount(2))
      ->needs(guard)
      ->type_name("S");
  add_file(*cmd, "--keep", o->keep,
           "Keep the response table that a base sends in this file,\nand drive with it after the next start")
      ->excludes(guard);
  add_file(*cmd, "--calibration", o->calibration,
           "Calibrate when a base orders it; keep the values in this file,\nand drive with them")
      ->excludes(guard);
  add_switch(*cmd, "--realtime", o->bus.real_time,
             "Be ready for a plant with --realtime: run before other processes");
  cmd->callback([o, &status] { status = execute(*o); });
}

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
