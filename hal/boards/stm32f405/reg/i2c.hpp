/// I2C.
#pragma once

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::i2c {  // I2C1

inline constexpr Register kCr1{0x00};           ///< CR1
inline constexpr Field kPe{0x00, 0, 1};         ///< CR1.PE
inline constexpr Field kStart{0x00, 8, 1};      ///< CR1.START
inline constexpr Field kStop{0x00, 9, 1};       ///< CR1.STOP
inline constexpr Field kAck{0x00, 10, 1};       ///< CR1.ACK
inline constexpr Field kPos{0x00, 11, 1};       ///< CR1.POS
inline constexpr Field kSwrst{0x00, 15, 1};     ///< CR1.SWRST
inline constexpr Field kFreq{0x04, 0, 6};       ///< CR2.FREQ
inline constexpr Register kDr{0x10};            ///< DR
inline constexpr Register kSr1{0x14};           ///< SR1
inline constexpr Field kSb{0x14, 0, 1};         ///< SR1.SB
inline constexpr Field kAddr{0x14, 1, 1};       ///< SR1.ADDR
inline constexpr Field kBtf{0x14, 2, 1};        ///< SR1.BTF
inline constexpr Field kRxne{0x14, 6, 1};       ///< SR1.RxNE
inline constexpr Field kTxe{0x14, 7, 1};        ///< SR1.TxE
inline constexpr Field kBerr{0x14, 8, 1};       ///< SR1.BERR
inline constexpr Field kArlo{0x14, 9, 1};       ///< SR1.ARLO
inline constexpr Field kAf{0x14, 10, 1};        ///< SR1.AF
inline constexpr Register kSr2{0x18};           ///< SR2
inline constexpr Field kBusy{0x18, 1, 1};       ///< SR2.BUSY
inline constexpr Register kCcr{0x1C};           ///< CCR
inline constexpr Field kCcrValue{0x1C, 0, 12};  ///< CCR.CCR
inline constexpr Field kFast{0x1C, 15, 1};      ///< CCR.F_S
inline constexpr Register kTrise{0x20};         ///< TRISE

}  // namespace whisker::hal::stm32f405::i2c
