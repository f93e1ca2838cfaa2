/// Pads of the pins.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::pads {  // PADS_BANK0

inline constexpr Register kGpio0{0x004};       ///< GPIO0
inline constexpr Field kSchmitt{0x004, 1, 1};  ///< GPIO0.SCHMITT
inline constexpr Field kPde{0x004, 2, 1};      ///< GPIO0.PDE
inline constexpr Field kPue{0x004, 3, 1};      ///< GPIO0.PUE
inline constexpr Field kIe{0x004, 6, 1};       ///< GPIO0.IE

}  // namespace whisker::hal::pico::pads
