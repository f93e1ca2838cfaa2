/// Serial interface of the flash.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::ssi {  // SSI

inline constexpr Register kSr{0x028};       ///< SR
inline constexpr Field kRfne{0x028, 3, 1};  ///< SR.RFNE
inline constexpr Register kDr0{0x060};      ///< DR0

}  // namespace whisker::hal::pico::ssi
