/// Power-on state machine.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::psm {  // PSM

inline constexpr Register kWdsel{0x008};    ///< WDSEL
inline constexpr Field kRosc{0x008, 0, 1};  ///< WDSEL.ROSC
inline constexpr Field kXosc{0x008, 1, 1};  ///< WDSEL.XOSC

}  // namespace whisker::hal::pico::psm
