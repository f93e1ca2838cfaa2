/// Timers: common registers of the advanced, the 32-bit and the 16-bit timers, and the outputs of TIM1.
#pragma once

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::tim {  // TIM1 TIM2 TIM3 TIM4

inline constexpr Field kCen{0x00, 0, 1};     ///< CR1.CEN
inline constexpr Field kArpe{0x00, 7, 1};    ///< CR1.ARPE
inline constexpr Field kSms{0x08, 0, 3};     ///< SMCR.SMS
inline constexpr Field kUg{0x14, 0, 1};      ///< EGR.UG
inline constexpr Register kEgr{0x14};        ///< EGR
inline constexpr Field kOc1m{0x18, 4, 3};    ///< CCMR1_Output.OC1M
inline constexpr Field kOc1pe{0x18, 3, 1};   ///< CCMR1_Output.OC1PE
inline constexpr Field kOc2m{0x18, 12, 3};   ///< CCMR1_Output.OC2M
inline constexpr Field kOc2pe{0x18, 11, 1};  ///< CCMR1_Output.OC2PE
inline constexpr Field kCc1s{0x18, 0, 2};    ///< CCMR1_Input.CC1S
inline constexpr Field kIc1f{0x18, 4, 4};    ///< CCMR1_Input.IC1F
inline constexpr Field kCc2s{0x18, 8, 2};    ///< CCMR1_Input.CC2S
inline constexpr Field kIc2f{0x18, 12, 4};   ///< CCMR1_Input.IC2F
inline constexpr Field kCc1e{0x20, 0, 1};    ///< CCER.CC1E
inline constexpr Field kCc1p{0x20, 1, 1};    ///< CCER.CC1P
inline constexpr Field kCc2e{0x20, 4, 1};    ///< CCER.CC2E
inline constexpr Field kCc2p{0x20, 5, 1};    ///< CCER.CC2P
inline constexpr Register kCnt{0x24};        ///< CNT
inline constexpr Register kPsc{0x28};        ///< PSC
inline constexpr Register kArr{0x2C};        ///< ARR
inline constexpr Register kCcr1{0x34};       ///< CCR1
inline constexpr Register kCcr2{0x38};       ///< CCR2
inline constexpr Field kMoe{0x44, 15, 1};    ///< BDTR.MOE

}  // namespace whisker::hal::stm32f405::tim
