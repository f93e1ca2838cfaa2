/// I2C.
#pragma once

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico::i2c {  // I2C0

inline constexpr Register kIcCon{0x000};              ///< IC_CON
inline constexpr Field kMasterMode{0x000, 0, 1};      ///< IC_CON.MASTER_MODE
inline constexpr Field kSpeed{0x000, 1, 2};           ///< IC_CON.SPEED
inline constexpr Field kIcRestartEn{0x000, 5, 1};     ///< IC_CON.IC_RESTART_EN
inline constexpr Field kIcSlaveDisable{0x000, 6, 1};  ///< IC_CON.IC_SLAVE_DISABLE
inline constexpr Register kIcTar{0x004};              ///< IC_TAR
inline constexpr Register kIcDataCmd{0x010};          ///< IC_DATA_CMD
inline constexpr Field kCmd{0x010, 8, 1};             ///< IC_DATA_CMD.CMD
inline constexpr Field kStop{0x010, 9, 1};            ///< IC_DATA_CMD.STOP
inline constexpr Field kRestart{0x010, 10, 1};        ///< IC_DATA_CMD.RESTART
inline constexpr Register kIcFsSclHcnt{0x01C};        ///< IC_FS_SCL_HCNT
inline constexpr Register kIcFsSclLcnt{0x020};        ///< IC_FS_SCL_LCNT
inline constexpr Register kIcIntrStat{0x02C};         ///< IC_INTR_STAT
inline constexpr Register kIcIntrMask{0x030};         ///< IC_INTR_MASK
inline constexpr Field kMTxAbrt{0x030, 6, 1};         ///< IC_INTR_MASK.M_TX_ABRT
inline constexpr Field kMStopDet{0x030, 9, 1};        ///< IC_INTR_MASK.M_STOP_DET
inline constexpr Register kIcClrTxAbrt{0x054};        ///< IC_CLR_TX_ABRT
inline constexpr Register kIcClrStopDet{0x060};       ///< IC_CLR_STOP_DET
inline constexpr Register kIcEnable{0x06C};           ///< IC_ENABLE
inline constexpr Register kIcRxflr{0x078};            ///< IC_RXFLR
inline constexpr Register kIcSdaHold{0x07C};          ///< IC_SDA_HOLD
inline constexpr Register kIcTxAbrtSource{0x080};     ///< IC_TX_ABRT_SOURCE
inline constexpr Field kArbLost{0x080, 12, 1};        ///< IC_TX_ABRT_SOURCE.ARB_LOST
inline constexpr Register kIcFsSpklen{0x0A0};         ///< IC_FS_SPKLEN

}  // namespace whisker::hal::pico::i2c
