/// Subsystem resets.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::resets {  // RESETS

inline constexpr Register kReset{0x000};         ///< RESET
inline constexpr Field kI2c0{0x000, 3, 1};       ///< RESET.I2C0
inline constexpr Field kIoBank0{0x000, 5, 1};    ///< RESET.IO_BANK0
inline constexpr Field kPadsBank0{0x000, 8, 1};  ///< RESET.PADS_BANK0
inline constexpr Field kPio0{0x000, 10, 1};      ///< RESET.PIO0
inline constexpr Field kPllSys{0x000, 12, 1};    ///< RESET.PLL_SYS
inline constexpr Field kPllUsb{0x000, 13, 1};    ///< RESET.PLL_USB
inline constexpr Field kPwm{0x000, 14, 1};       ///< RESET.PWM
inline constexpr Field kTimer{0x000, 21, 1};     ///< RESET.TIMER
inline constexpr Field kUart0{0x000, 22, 1};     ///< RESET.UART0
inline constexpr Field kUsbctrl{0x000, 24, 1};   ///< RESET.USBCTRL
inline constexpr Register kResetDone{0x008};     ///< RESET_DONE

}  // namespace whisker::hal::pico::resets
