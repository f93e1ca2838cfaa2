/// UART.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::uart {  // UART0

inline constexpr Register kUartdr{0x000};       ///< UARTDR
inline constexpr Register kUartfr{0x018};       ///< UARTFR
inline constexpr Field kRxfe{0x018, 4, 1};      ///< UARTFR.RXFE
inline constexpr Field kTxff{0x018, 5, 1};      ///< UARTFR.TXFF
inline constexpr Register kUartibrd{0x024};     ///< UARTIBRD
inline constexpr Register kUartfbrd{0x028};     ///< UARTFBRD
inline constexpr Register kUartlcrH{0x02C};     ///< UARTLCR_H
inline constexpr Field kFen{0x02C, 4, 1};       ///< UARTLCR_H.FEN
inline constexpr Field kWlen{0x02C, 5, 2};      ///< UARTLCR_H.WLEN
inline constexpr Register kUartcr{0x030};       ///< UARTCR
inline constexpr Field kUarten{0x030, 0, 1};    ///< UARTCR.UARTEN
inline constexpr Field kTxe{0x030, 8, 1};       ///< UARTCR.TXE
inline constexpr Field kRxe{0x030, 9, 1};       ///< UARTCR.RXE
inline constexpr Register kUartifls{0x034};     ///< UARTIFLS
inline constexpr Field kTxiflsel{0x034, 0, 3};  ///< UARTIFLS.TXIFLSEL
inline constexpr Field kRxiflsel{0x034, 3, 3};  ///< UARTIFLS.RXIFLSEL
inline constexpr Register kUartimsc{0x038};     ///< UARTIMSC
inline constexpr Field kRxim{0x038, 4, 1};      ///< UARTIMSC.RXIM
inline constexpr Field kTxim{0x038, 5, 1};      ///< UARTIMSC.TXIM
inline constexpr Field kRtim{0x038, 6, 1};      ///< UARTIMSC.RTIM
inline constexpr Field kOeim{0x038, 10, 1};     ///< UARTIMSC.OEIM
inline constexpr Register kUartmis{0x040};      ///< UARTMIS
inline constexpr Register kUarticr{0x044};      ///< UARTICR

}  // namespace whisker::hal::pico::uart
