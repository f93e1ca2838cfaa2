/// bxCAN.
#pragma once

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::can {  // CAN1

inline constexpr uint8_t kMailboxes = 3;
inline constexpr Field kInrq{0x00, 0, 1};                                   ///< MCR.INRQ
inline constexpr Field kSleep{0x00, 1, 1};                                  ///< MCR.SLEEP
inline constexpr Field kTxfp{0x00, 2, 1};                                   ///< MCR.TXFP
inline constexpr Field kInak{0x04, 0, 1};                                   ///< MSR.INAK
inline constexpr Register kTsr{0x08};                                       ///< TSR
inline constexpr Field kRqcp[]{{0x08, 0, 1}, {0x08, 8, 1}, {0x08, 16, 1}};  ///< TSR.RQCP0 TSR.RQCP1 TSR.RQCP2
inline constexpr Field kTxok[]{{0x08, 1, 1}, {0x08, 9, 1}, {0x08, 17, 1}};  ///< TSR.TXOK0 TSR.TXOK1 TSR.TXOK2
inline constexpr Field kAlst[]{
    {0x08, 2, 1}, {0x08, 10, 1}, {0x08, 18, 1}};  ///< TSR.ALST0 TSR.ALST1 TSR.ALST2
inline constexpr Field kTerr[]{
    {0x08, 3, 1}, {0x08, 11, 1}, {0x08, 19, 1}};  ///< TSR.TERR0 TSR.TERR1 TSR.TERR2
inline constexpr Field kAbrq[]{
    {0x08, 7, 1}, {0x08, 15, 1}, {0x08, 23, 1}};  ///< TSR.ABRQ0 TSR.ABRQ1 TSR.ABRQ2
inline constexpr Field kTme[]{{0x08, 26, 1}, {0x08, 27, 1}, {0x08, 28, 1}};  ///< TSR.TME0 TSR.TME1 TSR.TME2
inline constexpr Register kRf0r{0x0C};                                       ///< RF0R
inline constexpr Field kFmp0{0x0C, 0, 2};                                    ///< RF0R.FMP0
inline constexpr Field kFovr0{0x0C, 4, 1};                                   ///< RF0R.FOVR0
inline constexpr Field kRfom0{0x0C, 5, 1};                                   ///< RF0R.RFOM0
inline constexpr Field kFmpie0{0x14, 1, 1};                                  ///< IER.FMPIE0
inline constexpr Field kEpvf{0x18, 1, 1};                                    ///< ESR.EPVF
inline constexpr Field kBoff{0x18, 2, 1};                                    ///< ESR.BOFF
inline constexpr Register kBtr{0x1C};                                        ///< BTR
inline constexpr Field kBrp{0x1C, 0, 10};                                    ///< BTR.BRP
inline constexpr Field kTs1{0x1C, 16, 4};                                    ///< BTR.TS1
inline constexpr Field kTs2{0x1C, 20, 3};                                    ///< BTR.TS2
inline constexpr Field kSjw{0x1C, 24, 2};                                    ///< BTR.SJW
inline constexpr Register kTxId[]{{0x180}, {0x190}, {0x1A0}};                ///< TI0R TI1R TI2R
inline constexpr Register kTxSize[]{{0x184}, {0x194}, {0x1A4}};              ///< TDT0R TDT1R TDT2R
inline constexpr Register kTxLow[]{{0x188}, {0x198}, {0x1A8}};               ///< TDL0R TDL1R TDL2R
inline constexpr Register kTxHigh[]{{0x18C}, {0x19C}, {0x1AC}};              ///< TDH0R TDH1R TDH2R
inline constexpr Field kTxrq{0x180, 0, 1};                                   ///< TI0R.TXRQ
inline constexpr Register kRxId{0x1B0};                                      ///< RI0R
inline constexpr Field kRtr{0x1B0, 1, 1};                                    ///< RI0R.RTR
inline constexpr Field kIde{0x1B0, 2, 1};                                    ///< RI0R.IDE
inline constexpr Field kExid{0x1B0, 3, 18};                                  ///< RI0R.EXID
inline constexpr Field kStid{0x1B0, 21, 11};                                 ///< RI0R.STID
inline constexpr Field kDlc{0x1B4, 0, 4};                                    ///< RDT0R.DLC
inline constexpr Register kRxLow{0x1B8};                                     ///< RDL0R
inline constexpr Register kRxHigh{0x1BC};                                    ///< RDH0R
inline constexpr Field kFinit{0x200, 0, 1};                                  ///< FMR.FINIT
inline constexpr Field kFbm0{0x204, 0, 1};                                   ///< FM1R.FBM0
inline constexpr Field kFsc0{0x20C, 0, 1};                                   ///< FS1R.FSC0
inline constexpr Field kFfa0{0x214, 0, 1};                                   ///< FFA1R.FFA0
inline constexpr Field kFact0{0x21C, 0, 1};                                  ///< FA1R.FACT0
inline constexpr Register kF0r1{0x240};                                      ///< F0R1
inline constexpr Register kF0r2{0x244};                                      ///< F0R2

}  // namespace whisker::hal::stm32f405::can
