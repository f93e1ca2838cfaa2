#pragma once

#include "hal/boards/common/sonars.hpp"

namespace whisker::hal::pico {

/// The pins of three HC-SR04. The edges of their echo lines are interrupts, timed in microseconds.
class EchoLines {
 public:
  /// fitted: from now on. While no handler runs.
  void adopt(bool fitted) noexcept;
  /// Every millisecond. Triggers the sensor whose turn it is.
  void poll() noexcept;
  /// Handler of the edges.
  void on_interrupt() noexcept;
  Rangefinders& sonars() noexcept { return sonars_; }

 private:
  mcu::Sonars sonars_;
  bool fitted_ = false;
};

}  // namespace whisker::hal::pico
