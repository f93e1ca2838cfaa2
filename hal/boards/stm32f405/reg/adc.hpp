/// The first converter.
#pragma once

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::adc {  // ADC1

inline constexpr Register kSr{0x00};           ///< SR
inline constexpr Field kEoc{0x00, 1, 1};       ///< SR.EOC
inline constexpr Field kOvr{0x00, 5, 1};       ///< SR.OVR
inline constexpr Field kAdon{0x08, 0, 1};      ///< CR2.ADON
inline constexpr Field kSwstart{0x08, 30, 1};  ///< CR2.SWSTART
inline constexpr Register kSmpr1{0x0C};        ///< SMPR1
inline constexpr Field kSq1{0x34, 0, 5};       ///< SQR3.SQ1
inline constexpr Register kDr{0x4C};           ///< DR

}  // namespace whisker::hal::stm32f405::adc
