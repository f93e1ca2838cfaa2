/// Microseconds and alarms.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::timer {  // TIMER

inline constexpr Register kAlarm0{0x010};    ///< ALARM0
inline constexpr Register kTimerawl{0x028};  ///< TIMERAWL
inline constexpr Register kIntr{0x034};      ///< INTR
inline constexpr Register kInte{0x038};      ///< INTE

}  // namespace whisker::hal::pico::timer
