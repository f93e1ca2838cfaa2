/// USART.
#pragma once

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::usart {  // USART2

inline constexpr Register kSr{0x00};            ///< SR
inline constexpr Field kFe{0x00, 1, 1};         ///< SR.FE
inline constexpr Field kNf{0x00, 2, 1};         ///< SR.NF
inline constexpr Field kOre{0x00, 3, 1};        ///< SR.ORE
inline constexpr Field kRxne{0x00, 5, 1};       ///< SR.RXNE
inline constexpr Field kTxe{0x00, 7, 1};        ///< SR.TXE
inline constexpr Register kDr{0x04};            ///< DR
inline constexpr Register kBrr{0x08};           ///< BRR
inline constexpr Field kMantissa{0x08, 4, 12};  ///< BRR.DIV_Mantissa
inline constexpr Field kFraction{0x08, 0, 4};   ///< BRR.DIV_Fraction
inline constexpr Register kCr1{0x0C};           ///< CR1
inline constexpr Field kRe{0x0C, 2, 1};         ///< CR1.RE
inline constexpr Field kTe{0x0C, 3, 1};         ///< CR1.TE
inline constexpr Field kRxneie{0x0C, 5, 1};     ///< CR1.RXNEIE
inline constexpr Field kUe{0x0C, 13, 1};        ///< CR1.UE

}  // namespace whisker::hal::stm32f405::usart
