/// The independent watchdog.
#pragma once

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::iwdg {  // IWDG

inline constexpr Register kKr{0x00};      ///< KR
inline constexpr Register kPr{0x04};      ///< PR
inline constexpr Register kRlr{0x08};     ///< RLR
inline constexpr Field kPvu{0x0C, 0, 1};  ///< SR.PVU
inline constexpr Field kRvu{0x0C, 1, 1};  ///< SR.RVU

}  // namespace whisker::hal::stm32f405::iwdg
