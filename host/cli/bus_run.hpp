#pragma once

#include <memory>

#include "host/cli/bus_options.hpp"
#include "host/cli/live_view.hpp"
#include "host/cli/one_run.hpp"
#include "host/hil/bus_pilot.hpp"
#include "host/hil/line.hpp"

namespace whisker::cli {

/// Drives one scenario, as drive_one does, with the controller at the other end of the bus. Begins again when
/// the controller does. view: who watches it, or null. Returns the exit status; that of an interruption is
/// kInterrupted.
int drive_on_bus(const Scenario& scenario, RunOptions options, const RunOutputs& outputs,
                 const BusChoice& bus, hil::Line& line, LiveView* view);

/// The controller, until it is interrupted; it says on standard error what it does. Its pace is the plant's;
/// `real_time` only makes it ready for that.
void control_on_bus(const BusChoice& bus, PlannerKind planner, hil::Line& line);

}  // namespace whisker::cli
