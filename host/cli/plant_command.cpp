#include <memory>
#include <optional>
#include <string>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/cli/bus_options.hpp"
#include "host/cli/bus_run.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/cli/scenario_options.hpp"

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

}  // namespace whisker::cli
