/// The flash interface.
#pragma once

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::flash {  // FLASH

inline constexpr Field kLatency{0x00, 0, 3};  ///< ACR.LATENCY
inline constexpr Field kPrften{0x00, 8, 1};   ///< ACR.PRFTEN
inline constexpr Field kIcen{0x00, 9, 1};     ///< ACR.ICEN
inline constexpr Field kDcen{0x00, 10, 1};    ///< ACR.DCEN
inline constexpr Field kDcrst{0x00, 12, 1};   ///< ACR.DCRST
inline constexpr Register kKeyr{0x04};        ///< KEYR
inline constexpr Register kSr{0x0C};          ///< SR
inline constexpr Field kWrperr{0x0C, 4, 1};   ///< SR.WRPERR
inline constexpr Field kPgaerr{0x0C, 5, 1};   ///< SR.PGAERR
inline constexpr Field kPgperr{0x0C, 6, 1};   ///< SR.PGPERR
inline constexpr Field kPgserr{0x0C, 7, 1};   ///< SR.PGSERR
inline constexpr Field kBsy{0x0C, 16, 1};     ///< SR.BSY
inline constexpr Register kCr{0x10};          ///< CR
inline constexpr Field kPg{0x10, 0, 1};       ///< CR.PG
inline constexpr Field kSer{0x10, 1, 1};      ///< CR.SER
inline constexpr Field kSnb{0x10, 3, 4};      ///< CR.SNB
inline constexpr Field kPsize{0x10, 8, 2};    ///< CR.PSIZE
inline constexpr Field kStrt{0x10, 16, 1};    ///< CR.STRT
inline constexpr Field kLock{0x10, 31, 1};    ///< CR.LOCK

}  // namespace whisker::hal::stm32f405::flash
