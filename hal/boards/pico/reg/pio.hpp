/// Programmable input.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::pio {  // PIO0

inline constexpr Register kCtrl{0x000};             ///< CTRL
inline constexpr Field kSmEnable{0x000, 0, 4};      ///< CTRL.SM_ENABLE
inline constexpr Register kFstat{0x004};            ///< FSTAT
inline constexpr Field kRxempty{0x004, 8, 4};       ///< FSTAT.RXEMPTY
inline constexpr Register kRxf0{0x020};             ///< RXF0
inline constexpr Register kInstrMem0{0x048};        ///< INSTR_MEM0
inline constexpr Register kSm0Clkdiv{0x0C8};        ///< SM0_CLKDIV
inline constexpr Field kInt{0x0C8, 16, 16};         ///< SM0_CLKDIV.INT
inline constexpr Register kSm0Execctrl{0x0CC};      ///< SM0_EXECCTRL
inline constexpr Field kWrapBottom{0x0CC, 7, 5};    ///< SM0_EXECCTRL.WRAP_BOTTOM
inline constexpr Field kWrapTop{0x0CC, 12, 5};      ///< SM0_EXECCTRL.WRAP_TOP
inline constexpr Register kSm0Shiftctrl{0x0D0};     ///< SM0_SHIFTCTRL
inline constexpr Field kOutShiftdir{0x0D0, 19, 1};  ///< SM0_SHIFTCTRL.OUT_SHIFTDIR
inline constexpr Register kSm0Instr{0x0D8};         ///< SM0_INSTR
inline constexpr Register kSm0Pinctrl{0x0DC};       ///< SM0_PINCTRL
inline constexpr Field kInBase{0x0DC, 15, 5};       ///< SM0_PINCTRL.IN_BASE
inline constexpr Register kSm1Clkdiv{0x0E0};        ///< SM1_CLKDIV

}  // namespace whisker::hal::pico::pio
