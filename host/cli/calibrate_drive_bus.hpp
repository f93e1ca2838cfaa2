/// A mission of a calibration with the robot on a CAN bus.
#pragma once

#include <string>

#include "firmware/calibration/values.hpp"
#include "host/cli/bus_options.hpp"
#include "host/hil/line.hpp"

namespace whisker::cli {

struct BusMission {
  std::string trouble;  ///< empty: it has a result
  calibration::Values values;
  std::string found;  ///< for people
};

/// Takes the controller's place on the bus: waits for the base and its order to start, drives the mission
/// under the guard of the core, and stops. length_m: of a straight drive or a side. Prints what it waits for
/// on standard error. Throws SpinInterrupted.
BusMission drive_mission_on_bus(const BusChoice& bus, const Params& params, const std::string& mission,
                                double length_m, hil::Line& line);

}  // namespace whisker::cli
