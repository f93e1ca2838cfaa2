#pragma once

#include "hal/boards/common/vl53l0x.hpp"
#include "hal/boards/stm32f405/ranger_kind.hpp"

namespace whisker::hal::stm32f405 {

/// hal/boards/common/vl53l0x.hpp describes it.
extern const RangerKind kVl53l0x;

namespace vl53l0x = mcu::vl53l0x;

}  // namespace whisker::hal::stm32f405
