#include <memory>
#include <optional>
#include <string>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "firmware/can/limits.hpp"
#include "host/cli/bus_options.hpp"
#include "host/cli/bus_run.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/hil/file_storage.hpp"
#include "host/hil/host_rules.hpp"

namespace whisker::cli {
namespace {

struct ControllerOptions {
  BusChoice bus;
  PlannerKind planner = kDefaultPlanner;
  bool guard = false;
  double command_s = can::kVelocityLate_ms * 1e-3;
  std::string keep;
  std::string calibration;
};

/// Null without a file.
std::unique_ptr<hil::FileStorage> open_file(const char* option, const std::string& path) {
  if (path.empty()) return nullptr;
  try {
    return std::make_unique<hil::FileStorage>(path);
  } catch (const hil::FileStorageError& e) {
    throw UsageError(fmt::format("{}: {}", option, e.what()));
  }
}

std::unique_ptr<hil::FileStorage> open_storage(const ControllerOptions& o) {
  if (o.keep.empty()) return nullptr;
  if (hil::table_to_send(o.planner) == nullptr) {
    throw UsageError(fmt::format("--keep: planner {} takes no table", name(o.planner)));
  }
  return open_file("--keep", o.keep);
}

int execute(const ControllerOptions& o) {
  check_outputs({o.bus.record});
  if (!o.keep.empty() && o.keep == o.calibration) throw UsageError("--keep and --calibration: two files");
  const auto storage = open_storage(o);
  const auto kept = open_file("--calibration", o.calibration);
  std::optional<planning::Calibrator> calibrator;
  if (kept) calibrator.emplace(*kept);
  const auto line = hil::open_line(o.bus.name);
  if (o.guard) {
    guard_on_bus(o.bus, o.planner, o.command_s, *line);
  } else {
    control_on_bus(o.bus, o.planner, *line, storage.get(), calibrator ? &*calibrator : nullptr);
  }
  return 0;
}

}  // namespace

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

}  // namespace whisker::cli
