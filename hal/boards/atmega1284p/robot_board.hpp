#pragma once

#include "firmware/robot.hpp"
#include "hal/boards/atmega1284p/adc.hpp"
#include "hal/boards/atmega1284p/encoders.hpp"
#include "hal/boards/atmega1284p/motors.hpp"
#include "hal/boards/atmega1284p/sonar.hpp"
#include "hal/boards/atmega1284p/ticker.hpp"
#include "hal/boards/atmega1284p/watchdog.hpp"
#include "hal/boards/common/analogue_rangers.hpp"
#include "hal/boards/common/governed_wheels.hpp"
#include "hal/boards/common/nearer.hpp"

namespace whisker::hal::atmega1284p {

/// Every driver of the board. A debugger or an emulator sees how it does in three spare registers: GPIOR0 is
/// 1 while a tick runs and 0 otherwise, GPIOR1 the fault's number, GPIOR2 the troubles so far, modulo 256.
class RobotBoard {
 public:
  RobotBoard(const mcu::MotorParams& left, const mcu::MotorParams& right) noexcept;

  /// Once; switches interrupts on.
  void start() noexcept;
  /// Between two ticks, as often as there is time: sleeps until the next interrupt, a millisecond at most.
  void poll() noexcept;
  /// True once a period: the time for a tick, and the watchdog is fed.
  bool due(uint8_t period_ms) noexcept;
  Time now() noexcept { return Time::from_raw(clock_.now_ms()); }
  void show(const Status& status) noexcept;

  Rangefinders& rangefinders() noexcept { return beams_; }
  Drive& drive() noexcept { return wheels_; }

  Ticker& ticker() noexcept { return clock_; }
  Encoders& encoders() noexcept { return encoders_; }
  SonarRangers& sonar() noexcept { return sonar_; }

 private:
  Troubles troubles_;
  Ticker clock_;
  SonarRangers sonar_;
  Adc adc_;
  mcu::AnalogueRangers<Adc> infrared_;
  mcu::Nearer beams_;
  Motors motors_;
  Encoders encoders_;
  mcu::GovernedWheels<Motors, Encoders> wheels_;
  Watchdog watchdog_;
  uint32_t tick_ms_ = 0;
};

}  // namespace whisker::hal::atmega1284p
