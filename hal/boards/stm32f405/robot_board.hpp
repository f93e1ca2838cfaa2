#pragma once

#include "hal/boards/common/analogue_rangers.hpp"
#include "hal/boards/common/governed_wheels.hpp"
#include "hal/boards/common/nearer.hpp"
#include "hal/boards/stm32f405/adc.hpp"
#include "hal/boards/stm32f405/bump_switches.hpp"
#include "hal/boards/stm32f405/encoders.hpp"
#include "hal/boards/stm32f405/i2c_rangers.hpp"
#include "hal/boards/stm32f405/motors.hpp"
#include "hal/boards/stm32f405/mpu6050.hpp"
#include "hal/boards/stm32f405/node_board.hpp"
#include "hal/boards/stm32f405/push_button.hpp"

namespace whisker::hal::stm32f405 {

/// All drivers of the board; a failed one counts its failures.
///
///   board.start();
///   for (;;) { board.poll(robot.status()); if (board.due()) robot.tick(...); }
class RobotBoard {
 public:
  static constexpr uint16_t kWatchdogMs = NodeBoard::kWatchdogMs;

  /// gyro: the one of the robot's parameters. If none is fitted, nothing asks for it.
  RobotBoard(const RangerKind& kind, const mcu::MotorParams& left, const mcu::MotorParams& right,
             const GyroParams& gyro = {}, Facing facing = Facing::up) noexcept;

  /// Call once. Every wait in it is bounded: 100 ms in total if no device answers.
  void start() noexcept;
  /// Call between two ticks, as often as possible: serves sensors, gyro, switches, button, CAN, console.
  /// calibration: a word for the console; null: there is none.
  void poll(const Status& status, const char* calibration = nullptr) noexcept;
  /// True once per period: time for a tick. Also feeds the watchdog.
  bool due(uint32_t period_ms) noexcept { return node_.due(period_ms); }
  Time now() noexcept { return Time::from_raw(node_.now_ms()); }

  Rangefinders& rangefinders() noexcept { return beams_; }
  Bumper& bumper() noexcept { return switches_; }
  hal::Button& button() noexcept { return button_; }
  /// For the calibration, which is kept without power.
  Storage& storage() noexcept { return node_.calibration(); }
  hal::Gyro& gyro() noexcept { return gyro_; }
  Drive& drive() noexcept { return wheels_; }
  CanPort& can() noexcept { return node_.can(); }
  Usart& console() noexcept { return node_.console(); }
  const Troubles& troubles() const noexcept { return node_.troubles(); }

 private:
  NodeBoard node_;
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
};

}  // namespace whisker::hal::stm32f405
