/// USB controller, as a device.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::usb {  // USB

inline constexpr Register kAddrEndp{0x000};                 ///< ADDR_ENDP
inline constexpr Register kMainCtrl{0x040};                 ///< MAIN_CTRL
inline constexpr Field kControllerEn{0x040, 0, 1};          ///< MAIN_CTRL.CONTROLLER_EN
inline constexpr Register kSieCtrl{0x04C};                  ///< SIE_CTRL
inline constexpr Field kPullupEn{0x04C, 16, 1};             ///< SIE_CTRL.PULLUP_EN
inline constexpr Field kEp0Int1buf{0x04C, 29, 1};           ///< SIE_CTRL.EP0_INT_1BUF
inline constexpr Register kSieStatus{0x050};                ///< SIE_STATUS
inline constexpr Field kSuspended{0x050, 4, 1};             ///< SIE_STATUS.SUSPENDED
inline constexpr Field kResume{0x050, 11, 1};               ///< SIE_STATUS.RESUME
inline constexpr Field kSetupRec{0x050, 17, 1};             ///< SIE_STATUS.SETUP_REC
inline constexpr Field kBusReset{0x050, 19, 1};             ///< SIE_STATUS.BUS_RESET
inline constexpr Register kBuffStatus{0x058};               ///< BUFF_STATUS
inline constexpr Field kEp0In{0x058, 0, 1};                 ///< BUFF_STATUS.EP0_IN
inline constexpr Field kEp0Out{0x058, 1, 1};                ///< BUFF_STATUS.EP0_OUT
inline constexpr Field kEp2In{0x058, 4, 1};                 ///< BUFF_STATUS.EP2_IN
inline constexpr Field kEp2Out{0x058, 5, 1};                ///< BUFF_STATUS.EP2_OUT
inline constexpr Register kEpStallArm{0x068};               ///< EP_STALL_ARM
inline constexpr Field kStallEp0In{0x068, 0, 1};            ///< EP_STALL_ARM.EP0_IN
inline constexpr Field kStallEp0Out{0x068, 1, 1};           ///< EP_STALL_ARM.EP0_OUT
inline constexpr Register kUsbMuxing{0x074};                ///< USB_MUXING
inline constexpr Field kToPhy{0x074, 0, 1};                 ///< USB_MUXING.TO_PHY
inline constexpr Field kSoftcon{0x074, 3, 1};               ///< USB_MUXING.SOFTCON
inline constexpr Register kUsbPwr{0x078};                   ///< USB_PWR
inline constexpr Field kVbusDetect{0x078, 2, 1};            ///< USB_PWR.VBUS_DETECT
inline constexpr Field kVbusDetectOverrideEn{0x078, 3, 1};  ///< USB_PWR.VBUS_DETECT_OVERRIDE_EN
inline constexpr Register kInte{0x090};                     ///< INTE
inline constexpr Field kOnBuffStatus{0x090, 4, 1};          ///< INTE.BUFF_STATUS
inline constexpr Field kOnBusReset{0x090, 12, 1};           ///< INTE.BUS_RESET
inline constexpr Field kOnDevSuspend{0x090, 14, 1};         ///< INTE.DEV_SUSPEND
inline constexpr Field kOnDevResume{0x090, 15, 1};          ///< INTE.DEV_RESUME_FROM_HOST
inline constexpr Field kOnSetupReq{0x090, 16, 1};           ///< INTE.SETUP_REQ
inline constexpr Register kInts{0x098};                     ///< INTS

}  // namespace whisker::hal::pico::usb
