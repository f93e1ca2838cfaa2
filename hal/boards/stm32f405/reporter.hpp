#pragma once

#include "firmware/robot.hpp"
#include "hal/boards/stm32f405/usart.hpp"
#include "hal/can_port.hpp"

namespace whisker::hal::stm32f405 {

/// Reports the state of the robot on the console, one line at a time, without blocking:
///
/// ```
/// t 12340 running skirting fault none
/// calibration starts
/// i2c_timeout 7
/// can not_started 1
/// ```
/// The first line appears every second, followed by what a calibration does, if there is one, and by each
/// failure that has occurred.
class Reporter {
 public:
  static constexpr uint32_t kPeriodMs = 1000;

  /// All must outlive it.
  Reporter(Usart& usart, Troubles& troubles, const CanPort& can) noexcept
      : usart_(usart), troubles_(troubles), can_(can) {}

  /// Sends as much as there is room for. calibration: see RobotBoard::poll().
  void poll(uint32_t now_ms, const Status& status, const char* calibration) noexcept;

 private:
  static constexpr uint8_t kLongest = 100;
  void next_line(uint32_t now_ms, const Status& status, const char* calibration) noexcept;
  void add(const char* text) noexcept;
  void add(uint32_t number) noexcept;
  void add_counter(const char* text, uint32_t count) noexcept;

  Usart& usart_;
  Troubles& troubles_;
  const CanPort& can_;
  char line_[kLongest] = {};
  uint8_t size_ = 0;
  uint8_t sent_ = 0;
  uint8_t next_ = 0;  // line of the report
  uint32_t began_ms_ = 0;
};

}  // namespace whisker::hal::stm32f405
