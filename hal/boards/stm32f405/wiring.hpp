/// The connections of the pins.
#pragma once

#include "hal/boards/stm32f405/pin.hpp"
#include "hal/boards/stm32f405/reg/bases.hpp"

// Another board's own wiring is included before, and defines this: docs/development.md.
#ifndef WHISKER_WIRING
#define WHISKER_WIRING

namespace whisker::hal::stm32f405::wiring {

inline constexpr Pin kPwmLeft = {base::kGpioA, 8};  ///< TIM1, channel 1
inline constexpr Pin kPwmRight = {base::kGpioA, 9};
/// The driver's two direction inputs of each wheel: left forward, left backward, right forward, right
/// backward.
inline constexpr Pin kDirections[] = {
    {base::kGpioB, 12}, {base::kGpioB, 13}, {base::kGpioB, 14}, {base::kGpioB, 15}};
/// TIM3, the left wheel's A and B; TIM4, the right wheel's.
inline constexpr Pin kEncoders[] = {
    {base::kGpioC, 6}, {base::kGpioC, 7}, {base::kGpioB, 6}, {base::kGpioB, 7}};
inline constexpr Pin kConsoleOut = {base::kGpioA, 2};  ///< USART2
inline constexpr Pin kConsoleIn = {base::kGpioA, 3};
inline constexpr Pin kI2cClock = {base::kGpioB, 8};  ///< I2C1
inline constexpr Pin kI2cData = {base::kGpioB, 9};
/// Hold a rangefinder in reset while low: left, front, right.
inline constexpr Pin kRangerAwake[] = {{base::kGpioC, 8}, {base::kGpioC, 9}, {base::kGpioC, 10}};
/// Analogue infrared: left, front, right.
inline constexpr Pin kInfrared[] = {{base::kGpioC, 0}, {base::kGpioC, 1}, {base::kGpioC, 2}};
inline constexpr uint8_t kInfraredChannel[] = {10, 11, 12};
/// Switches to ground, for those who have them: left and right half of the bumper.
inline constexpr Pin kBumpers[] = {{base::kGpioC, 4}, {base::kGpioC, 5}};
/// A push button to ground, for those who have one: starts a calibration.
inline constexpr Pin kButton = {base::kGpioC, 13};
inline constexpr Pin kCanIn = {base::kGpioA, 11};  ///< CAN1
inline constexpr Pin kCanOut = {base::kGpioA, 12};

}  // namespace whisker::hal::stm32f405::wiring

#endif
