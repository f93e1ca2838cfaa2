/// Pins by port and number, and the board's wiring.
#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/io.hpp"
#include "hal/boards/stm32f405/reg/bases.hpp"

namespace whisker::hal::stm32f405 {

struct Pin {
  Address port;
  uint8_t number;  ///< 0..15
};

/// Which peripheral an alternate function is; the data sheet's table of alternate functions.
enum class Function : uint8_t { tim1 = 1, tim3_tim4 = 2, i2c = 4, usart = 7, can = 9 };

void make_output(Pin pin, bool high) noexcept;
/// Pulled down to 0 only; the line's resistor pulls it up.
void make_open_drain(Pin pin, bool high) noexcept;
void make_analogue(Pin pin) noexcept;
void make_function(Pin pin, Function function) noexcept;
/// As make_function, open drain.
void make_shared_line(Pin pin, Function function) noexcept;
/// As make_function, with a pull-up: for inputs that may be left open.
void make_function_pulled_up(Pin pin, Function function) noexcept;

void write(Pin pin, bool high) noexcept;
bool read(Pin pin) noexcept;

namespace wiring {
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
inline constexpr Pin kCanIn = {base::kGpioA, 11};  ///< CAN1
inline constexpr Pin kCanOut = {base::kGpioA, 12};
}  // namespace wiring

/// Switches on the clocks of the ports and peripherals that the board uses. Call it before any driver.
void power_peripherals() noexcept;
/// Gives every pin of `wiring` its function; motors off, rangefinders in reset.
void set_up_pins() noexcept;

}  // namespace whisker::hal::stm32f405
