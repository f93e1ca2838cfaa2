/// Functions of the pins, and their interrupts.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::io_bank0 {  // IO_BANK0

inline constexpr Register kGpio0Ctrl{0x004};         ///< GPIO0_CTRL
inline constexpr Field kFuncsel{0x004, 0, 5};        ///< GPIO0_CTRL.FUNCSEL
inline constexpr Register kIntr0{0x0F0};             ///< INTR0
inline constexpr Field kGpio0EdgeLow{0x0F0, 2, 1};   ///< INTR0.GPIO0_EDGE_LOW
inline constexpr Field kGpio0EdgeHigh{0x0F0, 3, 1};  ///< INTR0.GPIO0_EDGE_HIGH
inline constexpr Register kProc0Inte0{0x100};        ///< PROC0_INTE0
inline constexpr Register kProc0Ints0{0x120};        ///< PROC0_INTS0

}  // namespace whisker::hal::pico::io_bank0
