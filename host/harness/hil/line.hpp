/// Buses by name.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "hal/can_port.hpp"

namespace whisker::hil {

/// The bus is unavailable; what() is the reason in one line.
struct BusError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An open port to a bus.
class Line {
 public:
  virtual ~Line() = default;
  virtual hal::CanPort& port() = 0;
  /// Becomes readable when the port has something to receive; -1: not supported.
  virtual int descriptor() const = 0;
  /// For people: the reason why the port is off the bus, or understands nothing on it; else empty.
  virtual std::string waits_for() const = 0;
};

/// name: a CAN interface of Linux, or "slcan:PATH" for an adapter or a board at a serial device, a pseudo
/// terminal or a Unix socket; "slcan:PATH@BAUD" for another speed than 115200. The target need not exist yet.
/// Throws BusError.
std::unique_ptr<Line> open_line(const std::string& name);

/// The two ends of a private bus; each may be passed to another process. Throws BusError.
std::pair<std::unique_ptr<Line>, std::unique_ptr<Line>> private_lines();

}  // namespace whisker::hil
