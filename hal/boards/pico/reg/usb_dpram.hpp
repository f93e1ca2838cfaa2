/// What the USB controller shares with the program.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::usb_dpram {  // USB_DPRAM

inline constexpr Register kSetupPacketLow{0x000};        ///< SETUP_PACKET_LOW
inline constexpr Field kBmrequesttype{0x000, 0, 8};      ///< SETUP_PACKET_LOW.BMREQUESTTYPE
inline constexpr Field kBrequest{0x000, 8, 8};           ///< SETUP_PACKET_LOW.BREQUEST
inline constexpr Field kWvalue{0x000, 16, 16};           ///< SETUP_PACKET_LOW.WVALUE
inline constexpr Register kSetupPacketHigh{0x004};       ///< SETUP_PACKET_HIGH
inline constexpr Field kWindex{0x004, 0, 16};            ///< SETUP_PACKET_HIGH.WINDEX
inline constexpr Field kWlength{0x004, 16, 16};          ///< SETUP_PACKET_HIGH.WLENGTH
inline constexpr Register kEp1InControl{0x008};          ///< EP1_IN_CONTROL
inline constexpr Field kEndpointType{0x008, 26, 2};      ///< EP1_IN_CONTROL.ENDPOINT_TYPE
inline constexpr Field kInterruptPerBuff{0x008, 29, 1};  ///< EP1_IN_CONTROL.INTERRUPT_PER_BUFF
inline constexpr Field kEnable{0x008, 31, 1};            ///< EP1_IN_CONTROL.ENABLE
inline constexpr Register kEp2InControl{0x010};          ///< EP2_IN_CONTROL
inline constexpr Register kEp2OutControl{0x014};         ///< EP2_OUT_CONTROL
inline constexpr Register kEp0InBufferControl{0x080};    ///< EP0_IN_BUFFER_CONTROL
inline constexpr Field kLength{0x080, 0, 10};            ///< EP0_IN_BUFFER_CONTROL.LENGTH_0
inline constexpr Field kAvailable{0x080, 10, 1};         ///< EP0_IN_BUFFER_CONTROL.AVAILABLE_0
inline constexpr Field kStall{0x080, 11, 1};             ///< EP0_IN_BUFFER_CONTROL.STALL
inline constexpr Field kPid{0x080, 13, 1};               ///< EP0_IN_BUFFER_CONTROL.PID_0
inline constexpr Field kFull{0x080, 15, 1};              ///< EP0_IN_BUFFER_CONTROL.FULL_0
inline constexpr Register kEp0OutBufferControl{0x084};   ///< EP0_OUT_BUFFER_CONTROL
inline constexpr Register kEp1InBufferControl{0x088};    ///< EP1_IN_BUFFER_CONTROL
inline constexpr Register kEp2InBufferControl{0x090};    ///< EP2_IN_BUFFER_CONTROL
inline constexpr Register kEp2OutBufferControl{0x094};   ///< EP2_OUT_BUFFER_CONTROL

}  // namespace whisker::hal::pico::usb_dpram
