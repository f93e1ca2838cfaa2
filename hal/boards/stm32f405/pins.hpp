/// Pins by port and number.
#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/wiring.hpp"

namespace whisker::hal::stm32f405 {

/// Number of an alternate function; see the table of alternate functions in the data sheet.
enum class Function : uint8_t { tim1 = 1, tim3_tim4 = 2, i2c = 4, usart = 7, can = 9 };

void make_output(Pin pin, bool high) noexcept;
/// Open drain: only driven low; the resistor of the line pulls it up.
void make_open_drain(Pin pin, bool high) noexcept;
/// High while nothing pulls it low.
void make_input_pulled_up(Pin pin) noexcept;
void make_analogue(Pin pin) noexcept;
void make_function(Pin pin, Function function) noexcept;
/// As make_function, with open drain.
void make_shared_line(Pin pin, Function function) noexcept;
/// As make_function, with a pull-up, for inputs that may be unconnected.
void make_function_pulled_up(Pin pin, Function function) noexcept;

void write(Pin pin, bool high) noexcept;
bool read(Pin pin) noexcept;

/// Enables the clocks of all ports and peripherals that the board uses. Call it before any driver.
void power_peripherals() noexcept;
/// Configures every pin of `wiring`; motors off, rangefinders in reset.
void set_up_pins() noexcept;

}  // namespace whisker::hal::stm32f405
