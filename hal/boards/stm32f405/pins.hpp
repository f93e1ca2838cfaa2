/// Pins by port and number, and the wiring of the board.
#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/io.hpp"
#include "hal/boards/stm32f405/reg/bases.hpp"

namespace whisker::hal::stm32f405 {

struct Pin {
  Address port;
  uint8_t number;  ///< 0..15
};

/// Number of an alternate function; see the table of alternate functions in the data sheet.
enum class Function : uint8_t { tim1 = 1, tim3_tim4 = 2, i2c = 4, usart = 7, can = 9 };

void make_output(Pin pin, bool high) noexcept;
/// Open drain: only driven low; the resistor of the line pulls it up.
void make_open_drain(Pin pin, bool high) noexcept;
void make_analogue(Pin pin) noexcept;
void make_function(Pin pin, Function function) noexcept;
/// As make_function, with open drain.
void make_shared_line(Pin pin, Function function) noexcept;
/// As make_function, with a pull-up, for inputs that may be unconnected.
void make_function_pulled_up(Pin pin, Function function) noexcept;

void write(Pin pin, bool high) noexcept;
bool read(Pin pin) noexcept;

namespace wiring {
inline constexpr Pin kPwmLeft = {base::kGpioA, 8};  ///< TIM1, channel 1
inline constexpr Pin kPwmRight = {base::kGpioA, 9};
/// Direction inputs of the motor driver, two per wheel: left forward, left backward, right forward, right
/// backward.
inline constexpr Pin kDirections[] = {
    {base::kGpioB, 12}, {base::kGpioB, 13}, {base::kGpioB, 14}, {base::kGpioB, 15}};
/// TIM3: A and B of the left wheel; TIM4: those of the right wheel.
inline constexpr Pin kEncoders[] = {
    {base::kGpioC, 6}, {base::kGpioC, 7}, {base::kGpioB, 6}, {base::kGpioB, 7}};
inline constexpr Pin kConsoleOut = {base::kGpioA, 2};  ///< USART2
inline constexpr Pin kConsoleIn = {base::kGpioA, 3};
inline constexpr Pin kI2cClock = {base::kGpioB, 8};  ///< I2C1
inline constexpr Pin kI2cData = {base::kGpioB, 9};
/// A low level holds a rangefinder in reset: left, front, right.
inline constexpr Pin kRangerAwake[] = {{base::kGpioC, 8}, {base::kGpioC, 9}, {base::kGpioC, 10}};
/// Analogue infrared: left, front, right.
inline constexpr Pin kInfrared[] = {{base::kGpioC, 0}, {base::kGpioC, 1}, {base::kGpioC, 2}};
inline constexpr uint8_t kInfraredChannel[] = {10, 11, 12};
inline constexpr Pin kCanIn = {base::kGpioA, 11};  ///< CAN1
inline constexpr Pin kCanOut = {base::kGpioA, 12};
}  // namespace wiring

/// Enables the clocks of all ports and peripherals that the board uses. Call it before any driver.
void power_peripherals() noexcept;
/// Configures every pin of `wiring`; motors off, rangefinders in reset.
void set_up_pins() noexcept;

}  // namespace whisker::hal::stm32f405
