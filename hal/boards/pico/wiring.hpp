/// The connections of the pins. The build page's table and drawing are made from these lines.
#pragma once

#include <stdint.h>

namespace whisker::hal::pico::wiring {

using Gpio = uint8_t;  ///< number of a pin, 0..29

// Each comment: what is at the other end, and its terminal.
inline constexpr Gpio kLineOut = 0;          ///< serial cable: RX
inline constexpr Gpio kLineIn = 1;           ///< serial cable: TX
inline constexpr Gpio kLeftEcho = 2;         ///< left sensor: ECHO of an HC-SR04, by a divider
inline constexpr Gpio kFrontEcho = 3;        ///< front sensor: ECHO of an HC-SR04, by a divider
inline constexpr Gpio kI2cData = 4;          ///< VL53L0X, gyro: SDA
inline constexpr Gpio kI2cClock = 5;         ///< VL53L0X, gyro: SCL
inline constexpr Gpio kLeftAwake = 6;        ///< left sensor: XSHUT, or TRIG of an HC-SR04
inline constexpr Gpio kFrontAwake = 7;       ///< front sensor: XSHUT, or TRIG of an HC-SR04
inline constexpr Gpio kRightAwake = 8;       ///< right sensor: XSHUT, or TRIG of an HC-SR04
inline constexpr Gpio kRightEcho = 9;        ///< right sensor: ECHO of an HC-SR04, by a divider
inline constexpr Gpio kLeftEncoder = 10;     ///< left encoder: A
inline constexpr Gpio kLeftEncoderB = 11;    ///< left encoder: B
inline constexpr Gpio kRightEncoder = 12;    ///< right encoder: A
inline constexpr Gpio kRightEncoderB = 13;   ///< right encoder: B
inline constexpr Gpio kLeftBumper = 14;      ///< left bump switch: to ground
inline constexpr Gpio kRightBumper = 15;     ///< right bump switch: to ground
inline constexpr Gpio kLeftMotor = 16;       ///< motor driver: AIN1
inline constexpr Gpio kLeftMotorBack = 17;   ///< motor driver: AIN2
inline constexpr Gpio kRightMotor = 18;      ///< motor driver: BIN1
inline constexpr Gpio kRightMotorBack = 19;  ///< motor driver: BIN2
inline constexpr Gpio kMotorsAwake = 20;     ///< motor driver: SLP (TB6612: STBY)
inline constexpr Gpio kTick = 21;            ///< oscilloscope: high during a tick
inline constexpr Gpio kButton = 22;          ///< button: to ground
inline constexpr Gpio kLed = 25;             ///< on the Pico itself

inline constexpr Gpio kAwake[] = {kLeftAwake, kFrontAwake, kRightAwake};
inline constexpr const Gpio (&kTriggers)[3] = kAwake;
inline constexpr Gpio kEchoes[] = {kLeftEcho, kFrontEcho, kRightEcho};
inline constexpr Gpio kMotors[] = {kLeftMotor, kLeftMotorBack, kRightMotor, kRightMotorBack};
inline constexpr Gpio kEncoders[] = {kLeftEncoder, kLeftEncoderB, kRightEncoder, kRightEncoderB};
inline constexpr Gpio kBumpers[] = {kLeftBumper, kRightBumper};

}  // namespace whisker::hal::pico::wiring
