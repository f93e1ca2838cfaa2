/// Clock generators.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::clocks {  // CLOCKS

inline constexpr Register kClkRefCtrl{0x030};         ///< CLK_REF_CTRL
inline constexpr Register kClkRefSelected{0x038};     ///< CLK_REF_SELECTED
inline constexpr Register kClkSysCtrl{0x03C};         ///< CLK_SYS_CTRL
inline constexpr Register kClkSysSelected{0x044};     ///< CLK_SYS_SELECTED
inline constexpr Register kClkPeriCtrl{0x048};        ///< CLK_PERI_CTRL
inline constexpr Field kClkPeriEnable{0x048, 11, 1};  ///< CLK_PERI_CTRL.ENABLE
inline constexpr Register kClkUsbCtrl{0x054};         ///< CLK_USB_CTRL
inline constexpr Field kClkUsbEnable{0x054, 11, 1};   ///< CLK_USB_CTRL.ENABLE

}  // namespace whisker::hal::pico::clocks
