/// Watchdog, and the microsecond of the timer.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::watchdog {  // WATCHDOG

inline constexpr Register kCtrl{0x000};           ///< CTRL
inline constexpr Field kEnable{0x000, 30, 1};     ///< CTRL.ENABLE
inline constexpr Register kLoad{0x004};           ///< LOAD
inline constexpr Register kTick{0x02C};           ///< TICK
inline constexpr Field kCycles{0x02C, 0, 9};      ///< TICK.CYCLES
inline constexpr Field kTickEnable{0x02C, 9, 1};  ///< TICK.ENABLE

}  // namespace whisker::hal::pico::watchdog
