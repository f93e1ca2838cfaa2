#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "firmware/apps/can/remote_robot.hpp"
#include "firmware/can/node.hpp"
#include "firmware/can/rules_server.hpp"
#include "host/cli/cli11_forward.hpp"
#include "host/cli/live_view.hpp"
#include "host/cli/one_run.hpp"
#include "host/harness/bus/fault_port.hpp"
#include "host/harness/hil/bus_pilot.hpp"
#include "host/harness/hil/line.hpp"
#include "host/harness/run/planners.hpp"

namespace whisker::cli {

struct BusChoice {
  std::string name;
  int robot = 1;
  std::string record;
  double drop_percent = 0;  ///< of the frames in each direction
  bool real_time = false;

  std::optional<std::uint32_t> rules;              ///< digest that the controller must name; none: any
  const can::RulesServer::Table* table = nullptr;  ///< of that digest, to send it
  can::Order order = can::Order::start;            ///< start, spin or straight
  std::optional<PlannerKind>
      beside;  ///< the controller is on this computer, and was started with this planner

  /// The controller must drive with the table of this planner, which has one.
  void drive_with(PlannerKind planner);
  /// With a new boot number.
  can::Identity identity() const;
};

/// --can, --node, --record and --drop.
CLI::Option* add_bus(CLI::App& app, BusChoice& choice);

constexpr double kBitrate = 500000;  ///< bus for which the load is reported

/// The port with the losses of --drop. A recorder that this port wraps gets only the frames that pass on the
/// bus.
bus::FaultPort lossy(hal::CanPort& port, const BusChoice& choice);

/// Runs one scenario as drive_one does, with the controller at the other end of the bus. A calibration's goal
/// is its start. Starts again if the controller restarts. view: the live view, or null.
/// check: called while it waits; throws what ends the run. Returns the exit
/// status. Throws Interrupted.
int drive_on_bus(const Scenario& scenario, RunOptions options, const RunOutputs& outputs,
                 const BusChoice& bus, hil::Line& line, LiveView* view,
                 const std::function<void()>& check = nullptr);

/// Runs the controller until it is interrupted; it prints its actions on standard error. Its pace is that of
/// the plant; `real_time` only prepares it for that. storage: keeps the response table of a base; null: none.
/// calibrator: drives orders to calibrate; null: they are refused.
void control_on_bus(const BusChoice& bus, PlannerKind planner, hil::Line& line,
                    hal::Storage* storage = nullptr, planning::Calibrator* calibrator = nullptr);
/// The same with a guard node, whose assist has the planner's response table.
void guard_on_bus(const BusChoice& bus, PlannerKind rules, double longest_command_s, hil::Line& line);

/// The same with these planners, until `done`. heard: receives the actions, too. True: a signal ended it.
bool control_mission_on_bus(const BusChoice& bus, can_app::PlannerMaker& planners, hil::Line& line,
                            const std::function<void(const std::string&)>& heard,
                            const std::function<bool()>& done);

}  // namespace whisker::cli
