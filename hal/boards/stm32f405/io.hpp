/// Access to the registers of the chip: hal/boards/common/io.hpp.
#pragma once

#include "hal/boards/common/io.hpp"

namespace whisker::hal::stm32f405 {

using namespace mcu;

}  // namespace whisker::hal::stm32f405
