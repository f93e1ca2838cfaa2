/// Registers shared by the ADCs.
#pragma once

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::adc_common {  // C_ADC

inline constexpr Field kAdcpre{0x04, 16, 2};  ///< CCR.ADCPRE

}  // namespace whisker::hal::stm32f405::adc_common
