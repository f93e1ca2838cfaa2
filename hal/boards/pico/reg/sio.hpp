/// Pins of the core, and its divider.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::sio {  // SIO

inline constexpr Register kGpioIn{0x004};        ///< GPIO_IN
inline constexpr Register kGpioOutSet{0x014};    ///< GPIO_OUT_SET
inline constexpr Register kGpioOutClr{0x018};    ///< GPIO_OUT_CLR
inline constexpr Register kGpioOeSet{0x024};     ///< GPIO_OE_SET
inline constexpr Register kGpioOeClr{0x028};     ///< GPIO_OE_CLR
inline constexpr Register kDivUdividend{0x060};  ///< DIV_UDIVIDEND
inline constexpr Register kDivUdivisor{0x064};   ///< DIV_UDIVISOR
inline constexpr Register kDivSdividend{0x068};  ///< DIV_SDIVIDEND
inline constexpr Register kDivSdivisor{0x06C};   ///< DIV_SDIVISOR
inline constexpr Register kDivQuotient{0x070};   ///< DIV_QUOTIENT
inline constexpr Register kDivRemainder{0x074};  ///< DIV_REMAINDER

}  // namespace whisker::hal::pico::sio
