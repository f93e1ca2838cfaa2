#pragma once

#include <stdint.h>

#include "hal/can_port.hpp"

namespace whisker::can {

/// Restarts a port after bus-off, with a delay and a limit.
class BusGuard {
 public:
  /// Call after each poll of the port.
  void watch(hal::CanPort& port, uint32_t now_ms) noexcept;
  /// The port is on the bus.
  bool on_bus() const noexcept { return on_bus_; }
  /// Too many bus-offs: only a restart of the node brings it back.
  bool latched() const noexcept { return latched_; }
  uint32_t bus_offs() const noexcept { return bus_offs_; }

 private:
  static constexpr int kRemembered = 4;  // all recent ones except the latest
  void note_bus_off(uint32_t now_ms) noexcept;

  uint32_t before_[kRemembered] = {};
  uint32_t bus_offs_ = 0;  // as counted by the port, which may be off again before the next poll
  uint32_t silent_since_ = 0;
  bool silent_ = false;
  bool on_bus_ = false;
  bool latched_ = false;
};

}  // namespace whisker::can
