/// PLLs of the system clock and of the USB.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::pll {  // PLL_SYS PLL_USB

inline constexpr Register kCs{0x000};            ///< CS
inline constexpr Field kLock{0x000, 31, 1};      ///< CS.LOCK
inline constexpr Register kPwr{0x004};           ///< PWR
inline constexpr Field kPd{0x004, 0, 1};         ///< PWR.PD
inline constexpr Field kPostdivpd{0x004, 3, 1};  ///< PWR.POSTDIVPD
inline constexpr Field kVcopd{0x004, 5, 1};      ///< PWR.VCOPD
inline constexpr Register kFbdivInt{0x008};      ///< FBDIV_INT
inline constexpr Register kPrim{0x00C};          ///< PRIM
inline constexpr Field kPostdiv2{0x00C, 12, 3};  ///< PRIM.POSTDIV2
inline constexpr Field kPostdiv1{0x00C, 16, 3};  ///< PRIM.POSTDIV1

}  // namespace whisker::hal::pico::pll
