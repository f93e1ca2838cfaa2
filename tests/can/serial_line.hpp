/// A serial line between a bus and a node that acts as an SLCAN adapter.
#pragma once

#include "hal/ports/slcan/slcan.hpp"
#include "host/harness/bus/fault_port.hpp"
#include "tests/slcan/pipe.hpp"

namespace whisker::test {

class SerialLine {
 public:
  /// bus: the port of the computer; bytes_per_ms: in each direction.
  SerialLine(bus::FaultPort& bus, std::size_t bytes_per_ms) : bus_(bus), bytes_per_ms_(bytes_per_ms) {}

  /// The port of the node.
  hal::CanPort& node() { return node_; }
  /// Once a millisecond.
  void carry(std::uint32_t now_ms) {
    computer_end_.space = node_end_.space = bytes_per_ms_;
    bus_.poll(now_ms);
    hal::CanFrame frame{};
    while (bus_.receive(frame)) computer_.send(frame, kLife_ms);
    computer_.poll(now_ms);
    hal::slcan::exchange(computer_end_, node_end_);
    while (computer_.receive(frame)) bus_.send(frame, kLife_ms);
  }
  const hal::CanCounts& counts() const { return computer_.counts(); }

 private:
  static constexpr std::uint8_t kLife_ms = 20;

  bus::FaultPort& bus_;
  const std::size_t bytes_per_ms_;
  hal::slcan::Pipe computer_end_, node_end_;
  hal::slcan::Slcan computer_{computer_end_, hal::slcan::Role::host};
  hal::slcan::Slcan node_{node_end_, hal::slcan::Role::adapter};
};

}  // namespace whisker::test
