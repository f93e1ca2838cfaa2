/// The bench in the place of a controller.
#pragma once

#include <functional>

#include "host/bench/seat.hpp"
#include "host/cli/bench_bus.hpp"

namespace whisker::cli {

/// After listening for a while: the controller's place is free. Throws bench::NoAnswer if the robot has a
/// controller, or no base.
void check_place(BenchBus& bus, const BenchChoice& choice);

/// Until `over` for half a second, or the time is over. Throws bench::NoAnswer if the base gives no order, or
/// stops for longer than the time-out, and bench::Interrupted. Prints what it waits for on standard error.
void sit(BenchBus& bus, const BenchChoice& choice, bench::Seat& seat, double for_s,
         const std::function<bool()>& over, const std::function<bool()>& interrupted);

}  // namespace whisker::cli
