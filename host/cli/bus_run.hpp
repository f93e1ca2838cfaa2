#pragma once

#include <memory>

#include "host/cli/bus_options.hpp"
#include "host/cli/live_view.hpp"
#include "host/cli/one_run.hpp"
#include "host/hil/bus_pilot.hpp"
#include "host/hil/line.hpp"

namespace whisker::cli {

/// Runs one scenario as drive_one does, with the controller at the other end of the bus. Starts again if the
/// controller restarts. view: the live view, or null. Returns the exit status, kInterrupted after an
/// interruption.
int drive_on_bus(const Scenario& scenario, RunOptions options, const RunOutputs& outputs,
                 const BusChoice& bus, hil::Line& line, LiveView* view);

/// Runs the controller until it is interrupted; it prints its actions on standard error. Its pace is that of
/// the plant; `real_time` only prepares it for that.
void control_on_bus(const BusChoice& bus, PlannerKind planner, hil::Line& line);

}  // namespace whisker::cli
