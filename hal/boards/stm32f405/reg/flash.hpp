/// The flash interface.
#pragma once

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::flash {  // FLASH

inline constexpr Field kLatency{0x00, 0, 3};  ///< ACR.LATENCY
inline constexpr Field kPrften{0x00, 8, 1};   ///< ACR.PRFTEN
inline constexpr Field kIcen{0x00, 9, 1};     ///< ACR.ICEN
inline constexpr Field kDcen{0x00, 10, 1};    ///< ACR.DCEN

}  // namespace whisker::hal::stm32f405::flash
