/// Functions of the pins.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::io_bank0 {  // IO_BANK0

inline constexpr Register kGpio0Ctrl{0x004};   ///< GPIO0_CTRL
inline constexpr Field kFuncsel{0x004, 0, 5};  ///< GPIO0_CTRL.FUNCSEL

}  // namespace whisker::hal::pico::io_bank0
