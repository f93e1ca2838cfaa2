/// Crystal oscillator.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::xosc {  // XOSC

inline constexpr Register kCtrl{0x000};         ///< CTRL
inline constexpr Field kEnable{0x000, 12, 12};  ///< CTRL.ENABLE
inline constexpr Field kStable{0x004, 31, 1};   ///< STATUS.STABLE
inline constexpr Register kStartup{0x00C};      ///< STARTUP

}  // namespace whisker::hal::pico::xosc
