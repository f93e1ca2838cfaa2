/// Ring oscillator.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::rosc {  // ROSC

inline constexpr Register kRandombit{0x01C};  ///< RANDOMBIT

}  // namespace whisker::hal::pico::rosc
