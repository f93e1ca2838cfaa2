/// Where the peripherals are.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::base {

inline constexpr Address kSsi = 0x18000000;        ///< SSI
inline constexpr Address kClocks = 0x40008000;     ///< CLOCKS
inline constexpr Address kResets = 0x4000C000;     ///< RESETS
inline constexpr Address kPsm = 0x40010000;        ///< PSM
inline constexpr Address kIoBank0 = 0x40014000;    ///< IO_BANK0
inline constexpr Address kPadsBank0 = 0x4001C000;  ///< PADS_BANK0
inline constexpr Address kXosc = 0x40024000;       ///< XOSC
inline constexpr Address kPllSys = 0x40028000;     ///< PLL_SYS
inline constexpr Address kPllUsb = 0x4002C000;     ///< PLL_USB
inline constexpr Address kUart0 = 0x40034000;      ///< UART0
inline constexpr Address kI2c0 = 0x40044000;       ///< I2C0
inline constexpr Address kPwm = 0x40050000;        ///< PWM
inline constexpr Address kTimer = 0x40054000;      ///< TIMER
inline constexpr Address kWatchdog = 0x40058000;   ///< WATCHDOG
inline constexpr Address kRosc = 0x40060000;       ///< ROSC
inline constexpr Address kUsbDpram = 0x50100000;   ///< USB_DPRAM
inline constexpr Address kUsb = 0x50110000;        ///< USB
inline constexpr Address kPio0 = 0x50200000;       ///< PIO0
inline constexpr Address kSio = 0xD0000000;        ///< SIO
inline constexpr Address kPpb = 0xE0000000;        ///< PPB

}  // namespace whisker::hal::pico::base
