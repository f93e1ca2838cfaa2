#pragma once

#include "hal/boards/common/analogue_rangers.hpp"
#include "hal/boards/common/governed_wheels.hpp"
#include "hal/boards/common/nearer.hpp"
#include "hal/boards/stm32f405/adc.hpp"
#include "hal/boards/stm32f405/bump_switches.hpp"
#include "hal/boards/stm32f405/bx_can.hpp"
#include "hal/boards/stm32f405/encoders.hpp"
#include "hal/boards/stm32f405/i2c_rangers.hpp"
#include "hal/boards/stm32f405/motors.hpp"
#include "hal/boards/stm32f405/mpu6050.hpp"
#include "hal/boards/stm32f405/push_button.hpp"
#include "hal/boards/stm32f405/reporter.hpp"
#include "hal/boards/stm32f405/ticker.hpp"
#include "hal/boards/stm32f405/usart.hpp"
#include "hal/boards/stm32f405/watchdog.hpp"
#include "hal/boards/stm32f405/watched_storage.hpp"

namespace whisker::hal::stm32f405 {

/// All drivers of the board; a failed one counts its failures.
///
///   board.start();
///   for (;;) { board.poll(robot.status()); if (board.due()) robot.tick(...); }
class RobotBoard {
 public:
  static constexpr uint32_t kConsoleBaud = 115200;
  static constexpr uint32_t kCanBitrate = 500000;
  static constexpr uint16_t kWatchdogMs = 200;

  /// gyro: the one of the robot's parameters. If none is fitted, nothing asks for it.
  RobotBoard(const RangerKind& kind, const mcu::MotorParams& left, const mcu::MotorParams& right,
             const GyroParams& gyro = {}, Facing facing = Facing::up) noexcept;

  /// Call once. Every wait in it is bounded: 100 ms in total if no device answers.
  void start() noexcept;
  /// Call between two ticks, as often as possible: serves sensors, gyro, switches, button, CAN, console.
  /// calibration: a word for the console; null: there is none.
  void poll(const Status& status, const char* calibration = nullptr) noexcept;
  /// True once per period: time for a tick. Also feeds the watchdog.
  bool due(uint32_t period_ms) noexcept;
  Time now() noexcept { return Time::from_raw(ticker_.now_ms()); }

  Rangefinders& rangefinders() noexcept { return beams_; }
  Bumper& bumper() noexcept { return switches_; }
  hal::Button& button() noexcept { return button_; }
  /// For what is kept without power.
  Storage& storage() noexcept { return storage_; }
  hal::Gyro& gyro() noexcept { return gyro_; }
  Drive& drive() noexcept { return wheels_; }
  CanPort& can() noexcept { return can_; }
  Usart& console() noexcept { return console_; }
  const Troubles& troubles() const noexcept { return troubles_; }

  void on_console_interrupt() noexcept { console_.on_interrupt(); }
  void on_can_interrupt() noexcept { can_.on_receive_interrupt(); }

 private:
  Troubles troubles_;
  Ticker ticker_;
  Usart console_;
  I2c bus_;
  I2cRangers tof_;
  Mpu6050 gyro_;
  const bool has_gyro_;
  Adc adc_;
  mcu::AnalogueRangers<Adc> infrared_;
  mcu::Nearer beams_;
  BumpSwitches switches_;
  PushButton button_;
  Motors motors_;
  Encoders encoders_;
  mcu::GovernedWheels<Motors, Encoders> wheels_;
  BxCan can_;
  Watchdog watchdog_;
  WatchedStorage storage_;
  Reporter reporter_;
  Schedule schedule_;
};

}  // namespace whisker::hal::stm32f405
