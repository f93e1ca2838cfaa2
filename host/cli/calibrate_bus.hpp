#pragma once

#include <stdexcept>

#include "firmware/params.hpp"
#include "host/calibration/sample.hpp"
#include "host/cli/bus_run.hpp"
#include "host/hil/line.hpp"

namespace whisker::cli {

/// The spin could not be completed; what() is the reason in one line.
struct SpinError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A signal ended the spin. The base brakes by itself.
struct SpinInterrupted {};

/// along_m: see Spin. Takes the controller's place on the bus: waits for the base and its order to start,
/// turns on the spot there and back, and stops. Prints what it waits for on standard error. Throws SpinError
/// if the base stops the drive, and SpinInterrupted.
calibration::Sweep spin_on_bus(const BusChoice& bus, const Params& params, double along_m, hil::Line& line);

}  // namespace whisker::cli
