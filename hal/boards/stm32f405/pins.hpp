/// Pins by port and number.
#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/wiring.hpp"

namespace whisker::hal::stm32f405 {

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

/// Switches on the clocks of the ports and peripherals that the board uses. Call it before any driver.
void power_peripherals() noexcept;
/// Gives every pin of `wiring` its function; motors off, rangefinders in reset.
void set_up_pins() noexcept;

}  // namespace whisker::hal::stm32f405
