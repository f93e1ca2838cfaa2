/// Base addresses of the peripherals.
#pragma once

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::base {

inline constexpr Address kTim1 = 0x40010000;       ///< TIM1
inline constexpr Address kTim2 = 0x40000000;       ///< TIM2
inline constexpr Address kTim3 = 0x40000400;       ///< TIM3
inline constexpr Address kTim4 = 0x40000800;       ///< TIM4
inline constexpr Address kI2c1 = 0x40005400;       ///< I2C1
inline constexpr Address kCan1 = 0x40006400;       ///< CAN1
inline constexpr Address kUsart2 = 0x40004400;     ///< USART2
inline constexpr Address kIwdg = 0x40003000;       ///< IWDG
inline constexpr Address kAdc1 = 0x40012000;       ///< ADC1
inline constexpr Address kAdcCommon = 0x40012300;  ///< C_ADC
inline constexpr Address kGpioA = 0x40020000;      ///< GPIOA
inline constexpr Address kGpioB = 0x40020400;      ///< GPIOB
inline constexpr Address kGpioC = 0x40020800;      ///< GPIOC
inline constexpr Address kRcc = 0x40023800;        ///< RCC
inline constexpr Address kFlash = 0x40023C00;      ///< FLASH
inline constexpr Address kRng = 0x50060800;        ///< RNG
inline constexpr Address kNvic = 0xE000E100;       ///< NVIC

}  // namespace whisker::hal::stm32f405::base
