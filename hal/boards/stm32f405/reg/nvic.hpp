/// The interrupt controller.
#pragma once

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::nvic {  // NVIC

inline constexpr Register kIser[]{{0x00}, {0x04}, {0x08}};  ///< ISER0 ISER1 ISER2

}  // namespace whisker::hal::stm32f405::nvic
