/// Pulses.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::pwm {  // PWM

inline constexpr Register kCh0Csr{0x000};  ///< CH0_CSR
inline constexpr Field kEn{0x000, 0, 1};   ///< CH0_CSR.EN
inline constexpr Register kCh0Div{0x004};  ///< CH0_DIV
inline constexpr Field kInt{0x004, 4, 8};  ///< CH0_DIV.INT
inline constexpr Register kCh0Cc{0x00C};   ///< CH0_CC
inline constexpr Field kA{0x00C, 0, 16};   ///< CH0_CC.A
inline constexpr Field kB{0x00C, 16, 16};  ///< CH0_CC.B
inline constexpr Register kCh0Top{0x010};  ///< CH0_TOP
inline constexpr Register kCh1Csr{0x014};  ///< CH1_CSR

}  // namespace whisker::hal::pico::pwm
