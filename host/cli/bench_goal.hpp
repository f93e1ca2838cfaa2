/// A goal for a robot whose controller drives it.
#pragma once

#include "firmware/planning/planner.hpp"
#include "host/cli/bench_bus.hpp"

namespace whisker::cli {

/// Orders the goal as an operator, and follows the drive. Returns the exit status. After for_s, and after an
/// interruption, it cancels. Throws bench::NoAnswer.
int drive_through(BenchBus& bus, const planning::Goal& goal, double for_s, bool json);

}  // namespace whisker::cli
