/// The generator of random numbers.
#pragma once

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::rng {  // RNG

inline constexpr Field kRngen{0x00, 2, 1};  ///< CR.RNGEN
inline constexpr Field kDrdy{0x04, 0, 1};   ///< SR.DRDY
inline constexpr Register kDr{0x08};        ///< DR

}  // namespace whisker::hal::stm32f405::rng
