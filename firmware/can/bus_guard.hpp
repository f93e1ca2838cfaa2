#pragma once

#include <stdint.h>

#include "hal/can_port.hpp"

namespace whisker::can {

/// Brings a port back onto the bus: after a while, and not for ever.
class BusGuard {
 public:
  /// After each poll of the port.
  void watch(hal::CanPort& port, uint32_t now_ms) noexcept;
  /// The port takes part in the bus.
  bool on_bus() const noexcept { return on_bus_; }
  /// It left the bus too often: nothing but a new start brings it back.
  bool latched() const noexcept { return latched_; }
  uint32_t bus_offs() const noexcept { return bus_offs_; }

 private:
  static constexpr int kRemembered = 4;  // the last ones but the latest
  void note_bus_off(uint32_t now_ms) noexcept;

  uint32_t before_[kRemembered] = {};
  uint32_t bus_offs_ = 0;  // as the port counts them: it may be off again before the next look
  uint32_t silent_since_ = 0;
  bool silent_ = false;
  bool on_bus_ = false;
  bool latched_ = false;
};

}  // namespace whisker::can
