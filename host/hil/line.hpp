/// Buses by name.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "hal/can_port.hpp"

namespace whisker::hil {

/// The bus cannot be used; what() is the one line that says why.
struct BusError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A port to a bus, open.
class Line {
 public:
  virtual ~Line() = default;
  virtual hal::CanPort& port() = 0;
  /// Becomes readable when the port has something to receive; -1: none does.
  virtual int descriptor() const = 0;
  /// What keeps the port from the bus, for a person; empty: nothing.
  virtual std::string waits_for() const = 0;
};

/// name: a CAN interface of Linux, or "slcan:PATH" for an adapter or a board at a serial device, a pseudo
/// terminal or a Unix socket. What it names need not be there yet. Throws BusError.
std::unique_ptr<Line> open_line(const std::string& name);

/// The two ends of a bus that nobody else sees; each may go to another process. Throws BusError.
std::pair<std::unique_ptr<Line>, std::unique_ptr<Line>> private_lines();

}  // namespace whisker::hil
