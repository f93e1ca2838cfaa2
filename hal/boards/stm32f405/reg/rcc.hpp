/// Reset and clock control.
#pragma once

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::rcc {  // RCC

inline constexpr Register kCr{0x00};            ///< CR
inline constexpr Field kHsion{0x00, 0, 1};      ///< CR.HSION
inline constexpr Field kHsirdy{0x00, 1, 1};     ///< CR.HSIRDY
inline constexpr Field kHseon{0x00, 16, 1};     ///< CR.HSEON
inline constexpr Field kHserdy{0x00, 17, 1};    ///< CR.HSERDY
inline constexpr Field kPllon{0x00, 24, 1};     ///< CR.PLLON
inline constexpr Field kPllrdy{0x00, 25, 1};    ///< CR.PLLRDY
inline constexpr Register kPllcfgr{0x04};       ///< PLLCFGR
inline constexpr Field kPllm{0x04, 0, 6};       ///< PLLCFGR.PLLM0..PLLM5
inline constexpr Field kPlln{0x04, 6, 9};       ///< PLLCFGR.PLLN0..PLLN8
inline constexpr Field kPllp{0x04, 16, 2};      ///< PLLCFGR.PLLP0..PLLP1
inline constexpr Field kPllsrc{0x04, 22, 1};    ///< PLLCFGR.PLLSRC
inline constexpr Field kPllq{0x04, 24, 4};      ///< PLLCFGR.PLLQ0..PLLQ3
inline constexpr Field kSw{0x08, 0, 2};         ///< CFGR.SW0..SW1
inline constexpr Field kSws{0x08, 2, 2};        ///< CFGR.SWS0..SWS1
inline constexpr Field kHpre{0x08, 4, 4};       ///< CFGR.HPRE
inline constexpr Field kPpre1{0x08, 10, 3};     ///< CFGR.PPRE1
inline constexpr Field kPpre2{0x08, 13, 3};     ///< CFGR.PPRE2
inline constexpr Field kGpioaen{0x30, 0, 1};    ///< AHB1ENR.GPIOAEN
inline constexpr Field kGpioben{0x30, 1, 1};    ///< AHB1ENR.GPIOBEN
inline constexpr Field kGpiocen{0x30, 2, 1};    ///< AHB1ENR.GPIOCEN
inline constexpr Field kRngen{0x34, 6, 1};      ///< AHB2ENR.RNGEN
inline constexpr Field kTim2en{0x40, 0, 1};     ///< APB1ENR.TIM2EN
inline constexpr Field kTim3en{0x40, 1, 1};     ///< APB1ENR.TIM3EN
inline constexpr Field kTim4en{0x40, 2, 1};     ///< APB1ENR.TIM4EN
inline constexpr Field kUsart2en{0x40, 17, 1};  ///< APB1ENR.USART2EN
inline constexpr Field kI2c1en{0x40, 21, 1};    ///< APB1ENR.I2C1EN
inline constexpr Field kCan1en{0x40, 25, 1};    ///< APB1ENR.CAN1EN
inline constexpr Field kTim1en{0x44, 0, 1};     ///< APB2ENR.TIM1EN
inline constexpr Field kAdc1en{0x44, 8, 1};     ///< APB2ENR.ADC1EN

}  // namespace whisker::hal::stm32f405::rcc
