#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405 {

struct Pin {
  Address port;
  uint8_t number;  ///< 0..15
};

}  // namespace whisker::hal::stm32f405
